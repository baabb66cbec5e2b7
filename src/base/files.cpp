#include <fmt/format.h>

#include "fusee/base.h"
#define OPENSSL_SUPPRESS_DEPRECATED
#include <openssl/sha.h>

#include <array>
#include <cstdlib>

#include "base/output_list.h"

namespace fusee {
namespace {

namespace fs = std::filesystem;

/// Allocates the buffer at once when the size is known.
void reserve_for(const fs::path& path, std::size_t limit, std::string& bytes) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size <= limit) bytes.reserve(static_cast<std::size_t>(size));
}

}  // namespace

std::string read_file(const fs::path& path, std::size_t limit, FileAccess& files) {
  std::string bytes;
  reserve_for(path, limit, bytes);
  files.read({path, limit}, [&bytes](std::string_view block) { bytes += block; });
  return bytes;
}

fs::path temporary_folder() {
  std::error_code error;
  fs::path folder = fs::temp_directory_path(error);
  if (!error) return folder;
  const char* named = std::getenv("TMPDIR");
  throw OutputError("the temporary folder " + std::string(named ? named : "/tmp") + " is no folder",
                    "set TMPDIR to a folder that you may write to");
}

// The deprecated SHA256_* calls: EVP would first read its configuration, which costs a millisecond per run.
std::string sha256(std::string_view bytes) {
  SHA256_CTX context;
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest;
  demand(SHA256_Init(&context) == 1 && SHA256_Update(&context, bytes.data(), bytes.size()) == 1 &&
             SHA256_Final(digest.data(), &context) == 1,
         "SHA-256 is unavailable");
  std::string text;
  for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
  return text;
}

Json output_list(const std::vector<OutputFile>& files) {
  Json list = Json::array();
  for (const OutputFile& file : files)
    list.push_back({{"file", file.name}, {"bytes", file.bytes.size()}, {"sha256", sha256(file.bytes)}});
  return list;
}

}  // namespace fusee
