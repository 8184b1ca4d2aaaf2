// What the groups of the database are: classes, or the clusters that stand in for them.

export function kind({ data }) {
  return data.standIn ? "cluster" : "class";
}
