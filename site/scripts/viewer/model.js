// The 3D model of a shape, from the bytes that shapeviz_report/models.py packs.

/**
 * A shape as it is drawn.
 * @typedef {ReturnType<typeof unpackModel>} Model
 */

const POSITION_STEPS = 8191;

/** @param {ArrayBuffer} buffer */
export function unpackModel(buffer) {
  const [vertexCount, faceCount, dimensions] = new Uint32Array(buffer, 0, 3);
  let at = 12;
  /** @type {<Part extends { byteLength: number }>(Kind: { new (bytes: ArrayBuffer): Part, BYTES_PER_ELEMENT: number }, length: number) => Part} */
  const take = (Kind, length) => {
    // Parts follow each other without gaps, so that not every one starts where its kind may.
    const part = new Kind(buffer.slice(at, at + length * Kind.BYTES_PER_ELEMENT));
    at += part.byteLength;
    return part;
  };
  const view = take(Float32Array, 9);
  const steps = take(Int16Array, 3 * vertexCount);
  const first = take(Int32Array, faceCount);
  const others = take(Int32Array, 2 * faceCount);
  const nibbles = take(Uint8Array, dimensions * Math.ceil(vertexCount / 2));
  const channels = at < buffer.byteLength ? take(Uint8Array, 3 * vertexCount) : null;

  const positions = new Float32Array(3 * vertexCount);
  for (let vertex = 0; vertex < vertexCount; vertex += 1) {
    for (let axis = 0; axis < 3; axis += 1) {
      positions[3 * vertex + axis] = steps[axis * vertexCount + vertex] / POSITION_STEPS;
    }
  }
  const faces = new Uint32Array(3 * faceCount);
  for (let face = 0, lowest = 0; face < faceCount; face += 1) {
    lowest += first[face];
    faces[3 * face] = lowest;
    faces[3 * face + 1] = lowest + others[face];
    faces[3 * face + 2] = lowest + others[faceCount + face];
  }
  return {
    vertexCount,
    dimensions,
    view,
    positions,
    faces,
    /** Whether its file has colours. */
    colored: channels !== null,
    /**
     * The colour of a vertex as its file has it, sRGB from 0 to 255; null where it has none.
     * @param {number} vertex
     */
    color(vertex) {
      return channels && [0, 1, 2].map((channel) => channels[channel * vertexCount + vertex]);
    },
    /**
     * The bin from 0 of every vertex in one dimension of the descriptors.
     * @param {number} dimension
     */
    bins(dimension) {
      const row = nibbles.subarray(dimension * Math.ceil(vertexCount / 2));
      return Uint8Array.from({ length: vertexCount }, (_, vertex) => (row[vertex >> 1] >> (4 * (vertex & 1))) & 15);
    },
  };
}
