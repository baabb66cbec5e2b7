// Draco: vertices quantised on a grid over the bounding cube, or floats if no grid keeps the mesh a solid. Connectivity
// by edgebreaker.

#include <draco/compression/encode.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "export/mesh_files/mesh_files.h"
#include "export/mesh_files/mesh_formats.h"

namespace fusee::formats {
namespace {

// Writing ------------------------------------------------------------------------------------------------------------

/// A float holds 24 bits. A finer grid gains nothing, and Draco's tables grow with the grid.
constexpr int k_most_bits = 24;

/// Draco's grid: 2^bits − 1 steps along the longest side of the bounding box.
struct Grid {
  Vec3 origin = Vec3::Zero();
  double range = 0;
  int bits = 1;

  double step() const { return range / (std::ldexp(1.0, bits) - 1.0); }
  /// Half the diagonal of a cell, the largest displacement of a vertex.
  double largest_displacement() const { return 0.5 * std::numbers::sqrt3 * step(); }
  Vec3 snapped(const Vec3& v) const {
    return origin + step() * ((v - origin) / step() + Vec3::Constant(0.5)).array().floor().matrix();
  }
};

solid::TriangleMesh snapped(solid::TriangleMesh mesh, const Grid& grid) {
  for (Vec3& vertex : mesh.vertices) vertex = grid.snapped(vertex);
  return mesh;
}

/// True if every face keeps its orientation. Thin faces may collapse or turn over on a grid that meets the tolerance.
bool keeps_faces(const solid::TriangleMesh& mesh, const solid::TriangleMesh& on_grid) {
  constexpr double k_least_share = 0.1;  // of the area, projected on the original plane
  const auto area_vector = [](const std::vector<Vec3>& v, const std::array<std::uint32_t, 3>& t) {
    return Vec3((v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]));
  };
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
    const Vec3 before = area_vector(mesh.vertices, triangle);
    const double area_squared = before.squaredNorm();
    return area_squared == 0 || before.dot(area_vector(on_grid.vertices, triangle)) > k_least_share * area_squared;
  });
}

/// The coarsest grid within the tolerance that keeps the orientation of every face. Empty if even the finest does not,
/// and floats are used.
std::optional<Grid> grid_for(const solid::TriangleMesh& mesh, double tolerance) {
  const solid::Bounds box = solid::bounds(mesh);
  Grid grid{box.low, (box.high - box.low).maxCoeff(), 1};
  while (grid.bits < k_most_bits && grid.largest_displacement() > tolerance) ++grid.bits;
  for (; grid.bits <= k_most_bits; ++grid.bits) {
    if (keeps_faces(mesh, solid::rounded_to_float(snapped(mesh, grid)))) return grid;
  }
  return std::nullopt;
}

void fill(draco::Mesh& target, const solid::TriangleMesh& mesh) {
  target.SetNumFaces(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    target.SetFace(draco::FaceIndex(static_cast<std::uint32_t>(i)),
                   {draco::PointIndex(t[0]), draco::PointIndex(t[1]), draco::PointIndex(t[2])});
  }
  const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
  target.set_num_points(count);
  draco::GeometryAttribute position;
  position.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 3 * sizeof(float), 0);
  draco::PointAttribute* values = target.attribute(target.AddAttribute(position, true, count));
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::array<float, 3> v = {float(mesh.vertices[i].x()), float(mesh.vertices[i].y()),
                                    float(mesh.vertices[i].z())};
    values->SetAttributeValue(draco::AttributeValueIndex(i), v.data());
  }
}

// Reading ------------------------------------------------------------------------------------------------------------

/// Entropy coding lets a few bytes announce any number of faces, and Draco allocates the announced number. A real mesh
/// takes about a byte for each face. The bound also admits the most regular meshes, which take less.
constexpr std::uint64_t k_most_faces_per_byte = 64;
/// Bound on the ratio of decoded attributes to the file's size; below 20 for real meshes.
constexpr std::uint64_t k_most_unpacking = 256;

std::uint64_t announced_by_sequential(draco::DecoderBuffer buffer) {
  std::uint32_t faces = 0;
  std::uint32_t points = 0;
  if (!draco::DecodeVarint(&faces, &buffer) || !draco::DecodeVarint(&points, &buffer)) return 0;
  return std::max(faces, points);
}

std::uint64_t announced_by_edgebreaker(draco::DecoderBuffer buffer) {
  std::uint32_t vertices = 0;
  std::uint32_t faces = 0;
  std::uint8_t seams = 0;  // attributes with separate connectivity
  if (!draco::DecodeVarint(&vertices, &buffer) || !draco::DecodeVarint(&faces, &buffer) || !buffer.Decode(&seams))
    return 0;
  return std::uint64_t{std::max(vertices, faces)} * (1 + seams);
}

/// A Draco decoder that checks the announced numbers before allocation.
template <class Decoder, std::uint64_t (*announced)(draco::DecoderBuffer)>
class BoundedDecoder : public Decoder {
 public:
  explicit BoundedDecoder(std::uint64_t size) : size_(size) {}

 protected:
  bool DecodeConnectivity() override {
    return announced(*this->buffer()) <= k_most_faces_per_byte * size_ && Decoder::DecodeConnectivity();
  }
  bool DecodeAllAttributes() override {
    std::uint64_t bytes_per_point = 0;
    for (int i = 0; i < this->point_cloud()->num_attributes(); ++i) {
      const auto stride =
          static_cast<std::uint64_t>(std::max<std::int64_t>(0, this->point_cloud()->attribute(i)->byte_stride()));
      bytes_per_point += stride + sizeof(std::uint32_t);
    }
    return bytes_per_point * this->point_cloud()->num_points() <= k_most_unpacking * size_ &&
           Decoder::DecodeAllAttributes();
  }

 private:
  std::uint64_t size_;
};
using SequentialDecoder = BoundedDecoder<draco::MeshSequentialDecoder, announced_by_sequential>;
using EdgebreakerDecoder = BoundedDecoder<draco::MeshEdgebreakerDecoder, announced_by_edgebreaker>;

draco::DecoderBuffer buffer_of(const Source& source) {
  draco::DecoderBuffer buffer;
  buffer.Init(source.bytes.data(), source.bytes.size());
  return buffer;
}

draco::DracoHeader read_header(const Source& source) {
  draco::DecoderBuffer buffer = buffer_of(source);
  draco::DracoHeader header;
  const draco::Status status = draco::PointCloudDecoder::DecodeHeader(&buffer, &header);
  if (!status.ok()) fail_at_byte(source, 0, fmt::format("expected a Draco header: {}", status.error_msg()));
  constexpr std::size_t k_version = 5;  // bytes of the header
  constexpr std::size_t k_geometry = 7;
  if (header.encoder_type != draco::TRIANGULAR_MESH)
    fail_at_byte(source, k_geometry, "expected a mesh, found a cloud of points");
  // Earlier bitstreams announce their numbers in other ways, which the bounds above do not cover.
  if (header.version_major != 2 || header.version_minor != 2) {
    fail_at_byte(
        source, k_version,
        fmt::format("expected Draco's bitstream 2.2, found {}.{}", header.version_major, header.version_minor));
  }
  return header;
}

template <class Decoder>
void decode(const Source& source, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer = buffer_of(source);
  const draco::DecoderOptions options;
  std::string reason;
  try {
    const draco::Status status = Decoder(source.bytes.size()).Decode(options, &buffer, &mesh);
    if (status.ok()) return;
    reason = status.error_msg_string();
  } catch (const std::exception& error) {  // thrown by a container for an excessive size
    reason = error.what();
  }
  fail_at_byte(source, static_cast<std::size_t>(std::max<std::int64_t>(0, buffer.decoded_size())),
               fmt::format("Draco cannot decode this: {}", reason));
}

/// Replaces ConvertValue(), which trusts a flag from the file.
template <class Number>
std::vector<Vec3> positions_of(const Source& source, const draco::Mesh& mesh, const draco::PointAttribute& position) {
  std::vector<Vec3> positions;
  positions.reserve(mesh.num_points());
  for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
    std::array<Number, 3> v{};
    const draco::AttributeValueIndex value = position.mapped_index(draco::PointIndex(i));
    if (value.value() >= position.size() || !position.GetValue<Number, 3>(value, &v))
      fail_at_byte(source, 0, fmt::format("point {} has no position", i));
    positions.emplace_back(v[0], v[1], v[2]);
  }
  return positions;
}

std::vector<Vec3> positions_of(const Source& source, const draco::Mesh& mesh) {
  const draco::PointAttribute* position = mesh.GetNamedAttribute(draco::GeometryAttribute::POSITION);
  if (position != nullptr && position->num_components() == 3) {
    if (position->data_type() == draco::DT_FLOAT32) return positions_of<float>(source, mesh, *position);
    if (position->data_type() == draco::DT_FLOAT64) return positions_of<double>(source, mesh, *position);
  }
  fail_at_byte(source, 0, "expected positions of three coordinates, floats or doubles");
}

solid::TriangleMesh from_draco(const Source& source, const draco::Mesh& mesh) {
  solid::TriangleMesh soup;
  soup.vertices = positions_of(source, mesh);
  soup.triangles.reserve(mesh.num_faces());
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
    const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
    for (const draco::PointIndex& corner : face) {
      if (corner.value() >= mesh.num_points())
        fail_at_byte(source, 0, fmt::format("face {} refers to point {} of {}", i, corner.value(), mesh.num_points()));
    }
    soup.triangles.push_back({face[0].value(), face[1].value(), face[2].value()});
  }
  return soup;
}

std::string encoded(const solid::TriangleMesh& mesh, const std::optional<Grid>& grid) {
  draco::Mesh target;
  fill(target, mesh);
  draco::Encoder encoder;
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  if (grid) encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, grid->bits);
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeMeshToBuffer(target, &buffer);
  demand(status.ok(), fmt::format("Draco, {} bits: {}", grid ? grid->bits : 32, status.error_msg()));
  return {buffer.data(), buffer.size()};
}

DracoFile read_back(std::string bytes) {
  DracoFile file{std::move(bytes), {}, {}};
  file.decoded = read_drc({file.bytes, "pulley.drc"});
  file.checks = solid::check_mesh(file.decoded);
  return file;
}

}  // namespace

// A grid is checked on the decoded file: close faces may cross without changing their orientation, and Draco's
// arithmetic rounds again.
DracoFile draco_file(const solid::TriangleMesh& mesh, double tolerance) {
  for (std::optional<Grid> grid = grid_for(mesh, tolerance); grid && grid->bits <= k_most_bits; ++grid->bits) {
    DracoFile file = read_back(encoded(mesh, grid));
    if (all_ok(file.checks)) return file;
  }
  return read_back(encoded(mesh, std::nullopt));
}

std::string draco_bytes(const solid::TriangleMesh& mesh, double tolerance) { return draco_file(mesh, tolerance).bytes; }

/// At seams of attributes Draco stores a point for each side. They are welded by position.
solid::TriangleMesh read_drc(const Source& source) {
  const draco::DracoHeader header = read_header(source);
  draco::Mesh mesh;
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
    decode<EdgebreakerDecoder>(source, mesh);
  } else if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
    decode<SequentialDecoder>(source, mesh);
  } else {
    constexpr std::size_t k_method = 8;  // byte of the header
    fail_at_byte(source, k_method, fmt::format("expected Draco's method 0 or 1, found {}", header.encoder_method));
  }
  return solid::weld(from_draco(source, mesh));
}

}  // namespace fusee::formats
