// PFH and FPFH of a point cloud by the Point Cloud Library.
//
//   pcl_histograms pfh|fpfh FOLDER K [listed]
//
// FOLDER holds, in native byte order and without headers, points.f32 and normals.f32 (n x 3). With "listed" the
// neighbourhoods are those of neighbours.i32 (n x K, each beginning with the point itself); without, they are the K
// nearest points (the point itself is one of them) that PCL's own tree finds. Writes values.f32 (n x 125 or n x 33)
// and prints the CPU seconds from the bare points to the values, the tree and the search included.

#include <ctime>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <pcl/features/fpfh.h>
#include <pcl/features/pfh.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

using Points = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;

template <typename Value>
std::vector<Value> read(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::vector<Value> values(file.tellg() / sizeof(Value));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(values.data()), values.size() * sizeof(Value));
  return values;
}

// Answers every search with a list made beforehand, so that two libraries see the same neighbourhoods.
class ListedNeighbours : public pcl::search::Search<pcl::PointXYZ> {
 public:
  ListedNeighbours(std::vector<int> lists, int size) : Search("listed"), lists_(std::move(lists)), size_(size) {}

  int nearestKSearch(const Points& cloud, pcl::index_t index, int, pcl::Indices& indices,
                     std::vector<float>& squared) const override {
    indices.assign(lists_.begin() + index * size_, lists_.begin() + (index + 1) * size_);
    squared.resize(size_);
    for (int s = 0; s < size_; ++s)
      squared[s] = (cloud[indices[s]].getVector3fMap() - cloud[index].getVector3fMap()).squaredNorm();
    return size_;
  }
  int nearestKSearch(const pcl::PointXYZ&, int, pcl::Indices&, std::vector<float>&) const override {
    throw std::logic_error("only the points of the cloud have lists");
  }
  int radiusSearch(const pcl::PointXYZ&, double, pcl::Indices&, std::vector<float>&, unsigned) const override {
    throw std::logic_error("lists know no radius");
  }

 private:
  std::vector<int> lists_;
  int size_;
};

template <typename Estimation, typename Signature>
void run(const std::string& folder, int size, bool listed) {
  const auto xyz = read<float>(folder + "/points.f32");
  const auto directions = read<float>(folder + "/normals.f32");
  auto points = pcl::make_shared<Points>();
  auto normals = pcl::make_shared<Normals>();
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) {
    points->emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
    normals->emplace_back(directions[i], directions[i + 1], directions[i + 2]);
  }
  std::vector<int> lists;
  if (listed) lists = read<int>(folder + "/neighbours.i32");

  const std::clock_t start = std::clock();
  Estimation estimation;
  estimation.setInputCloud(points);
  estimation.setInputNormals(normals);
  estimation.setKSearch(size);
  if (listed)
    estimation.setSearchMethod(pcl::make_shared<ListedNeighbours>(std::move(lists), size));
  else
    estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  pcl::PointCloud<Signature> values;
  estimation.compute(values);
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;

  std::ofstream file(folder + "/values.f32", std::ios::binary);
  for (const auto& value : values)
    file.write(reinterpret_cast<const char*>(value.histogram), sizeof(value.histogram));
  std::cout << seconds << std::endl;
}

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  if (words.size() < 3 || (words[0] != "pfh" && words[0] != "fpfh") || (words.size() > 3 && words[3] != "listed")) {
    std::cerr << "usage: pcl_histograms pfh|fpfh FOLDER K [listed]\n";
    return 2;
  }
  try {
    const int size = std::stoi(words[2]);
    const bool listed = words.size() > 3;
    if (words[0] == "pfh")
      run<pcl::PFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::PFHSignature125>, pcl::PFHSignature125>(words[1], size,
                                                                                                   listed);
    else
      run<pcl::FPFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::FPFHSignature33>, pcl::FPFHSignature33>(words[1], size,
                                                                                                    listed);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
