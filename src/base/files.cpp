#include "fusee/base/files.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include "base/output_list.h"
#include "base/staging.h"
#include "fusee/base/diagnostics.h"

namespace fusee {
namespace {

namespace fs = std::filesystem;

/// All at once, where the size is known beforehand.
void reserve_for(const fs::path& path, std::size_t limit, std::string& bytes) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size <= limit) bytes.reserve(static_cast<std::size_t>(size));
}

}  // namespace

void read_blocks(const ReadRequest& request, const TakeBlock& take) {
  if (FileAccess* access = FileAccess::current()) return access->read(request, take);
  read_from_disk(request, take);
}

std::string read_file(const fs::path& path, std::size_t limit) {
  std::string bytes;
  reserve_for(path, limit, bytes);
  read_blocks({path, limit}, [&bytes](std::string_view block) { bytes += block; });
  return bytes;
}

std::string read_output(const fs::path& path, std::size_t limit) {
  std::string bytes;
  reserve_for(path, limit, bytes);
  read_as_it_lies({path, limit}, [&bytes](std::string_view block) { bytes += block; });
  return bytes;
}

std::string sha256(std::string_view bytes) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  demand(EVP_Digest(bytes.data(), bytes.size(), digest, &size, EVP_sha256(), nullptr) == 1, "SHA-256 is not to be had");
  std::string text;
  for (unsigned int i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

Json output_list(const std::vector<OutputFile>& files) {
  Json list = Json::array();
  for (const OutputFile& file : files)
    list.push_back({{"file", file.name}, {"bytes", file.bytes.size()}, {"sha256", sha256(file.bytes)}});
  return list;
}

}  // namespace fusee
