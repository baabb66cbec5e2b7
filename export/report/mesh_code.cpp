#include "export/report/mesh_code.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace fusee::formats {
namespace {

constexpr double k_levels = 65535;  // steps along the longest side of the bounding box: 16 bits
constexpr std::uint32_t k_unvisited = std::numeric_limits<std::uint32_t>::max();

void put_varint(std::string& bytes, std::uint32_t value) {
  for (; value >= 128; value >>= 7) bytes += static_cast<char>(128 | (value & 127));
  bytes += static_cast<char>(value);
}

std::uint32_t zigzag(int value) {
  return value >= 0 ? 2u * static_cast<std::uint32_t>(value) : 2u * static_cast<std::uint32_t>(-value) - 1u;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? k_digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

bool is_valid(const solid::TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return false;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t index : triangle) {
      if (index >= mesh.vertices.size() || !mesh.vertices[index].allFinite()) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<MeshCode> encode_mesh(const solid::TriangleMesh& mesh) {
  if (!is_valid(mesh)) return std::nullopt;
  MeshCode code;
  code.low = mesh.vertices[mesh.triangles[0][0]];
  Vec3 high = code.low;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t index : triangle) {
      code.low = code.low.cwiseMin(mesh.vertices[index]);
      high = high.cwiseMax(mesh.vertices[index]);
    }
  }
  code.step = (high - code.low).maxCoeff() / k_levels;
  if (!(code.step > 0) || !std::isfinite(code.step)) return std::nullopt;

  std::string bytes;
  std::vector<std::uint32_t> order_of(mesh.vertices.size(), k_unvisited);
  std::uint32_t newest = 0;
  std::array<int, 3> previous{0, 0, 0};
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t index : triangle) {
      if (order_of[index] != k_unvisited) {
        put_varint(bytes, newest - order_of[index]);
        continue;
      }
      order_of[index] = newest++;
      put_varint(bytes, 0);
      for (int axis = 0; axis < 3; ++axis) {
        const int level = static_cast<int>(std::lround((mesh.vertices[index][axis] - code.low[axis]) / code.step));
        put_varint(bytes, zigzag(level - previous[axis]));
        previous[axis] = level;
      }
    }
  }
  code.base64 = base64(bytes);
  code.vertices = newest;
  code.triangles = mesh.triangles.size();
  return code;
}

}  // namespace fusee::formats
