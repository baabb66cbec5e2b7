#include "measurement/unpacking.h"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

namespace fusee::measurement {
namespace {

/// Unpacked bytes for each packed byte.
constexpr std::size_t k_largest_ratio = 1000;
constexpr std::size_t k_unpacked_block = std::size_t{1} << 17;  // bytes

/// Appends room for one more block, within the limit; false if the limit is reached.
bool make_room(std::string& bytes, std::size_t used, std::size_t most) {
  if (used >= most) return false;
  bytes.resize(used + std::min(k_unpacked_block, most - used));
  return true;
}

UnpackedBytes unpack_zstd(std::string_view packed, std::size_t most) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), &ZSTD_freeDCtx);
  UnpackedBytes result;
  std::size_t used = 0;
  std::size_t wanted = 1;  // 0 at the end of a frame
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  for (bool is_stuck = false; !is_stuck && (in.pos < in.size || wanted != 0);) {
    if (!make_room(result.bytes, used, most)) break;
    ZSTD_outBuffer out{result.bytes.data() + used, result.bytes.size() - used, 0};
    const std::size_t before = in.pos;
    wanted = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(wanted) != 0) break;
    used += out.pos;
    is_stuck = out.pos == 0 && in.pos == before;  // cut off: no progress
  }
  result.whole = wanted == 0 && in.pos == in.size;
  result.bytes.resize(used);
  return result;
}

UnpackedBytes unpack_lz4(std::string_view packed, std::size_t most) {
  LZ4F_dctx* created = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&created, LZ4F_VERSION)) != 0) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(created,
                                                                                     &LZ4F_freeDecompressionContext);
  UnpackedBytes result;
  std::size_t used = 0, read = 0;
  std::size_t wanted = 1;  // 0 at the end of a frame
  for (bool is_stuck = false; !is_stuck && (read < packed.size() || wanted != 0);) {
    if (!make_room(result.bytes, used, most)) break;
    std::size_t written = result.bytes.size() - used, taken = packed.size() - read;
    wanted =
        LZ4F_decompress(context.get(), result.bytes.data() + used, &written, packed.data() + read, &taken, nullptr);
    if (LZ4F_isError(wanted) != 0) break;
    used += written;
    read += taken;
    is_stuck = written == 0 && taken == 0;
  }
  result.whole = wanted == 0 && read == packed.size();
  result.bytes.resize(used);
  return result;
}

}  // namespace

bool is_zstd(std::string_view bytes) { return bytes.starts_with("\x28\xB5\x2F\xFD"); }

UnpackedBytes unpack(Packing packing, std::string_view packed, std::size_t most) {
  if (packing == Packing::zstd) return unpack_zstd(packed, most);
  if (packing == Packing::lz4) return unpack_lz4(packed, most);
  return {std::string(packed.substr(0, most)), packed.size() <= most};
}

std::size_t UnpackingLimit::raise_for(std::size_t packed) {
  left_ += k_largest_ratio * packed;
  return left_;
}

}  // namespace fusee::measurement
