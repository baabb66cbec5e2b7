#include "fusee/base/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>

#include "base/descriptor.h"
#include "base/output_list.h"
#include "fusee/base/diagnostics.h"

namespace fusee {
namespace {

namespace fs = std::filesystem;

std::string error_text(int code) { return std::error_code(code, std::generic_category()).message(); }

}  // namespace

std::string read_file(const fs::path& path, std::size_t limit) {
  const std::string name = path.string();
  // O_NONBLOCK: a pipe that nobody writes to must not hang us.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (!file.ok())
    throw InputError(name, "cannot be read: " + error_text(errno), errno == ENOENT ? "check the path" : "");
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) throw InputError(name, "cannot be read: " + error_text(errno));
  if (S_ISDIR(status.st_mode)) throw InputError(name, "is a directory", "name a file in it");
  if (!S_ISREG(status.st_mode)) throw InputError(name, "is not a regular file", "write it to a file first");
  const auto too_large = [&] {
    return InputError(name, fmt::format("is larger than {} bytes", limit), "is it the right file?");
  };
  if (static_cast<std::uintmax_t>(status.st_size) > limit) throw too_large();
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t filled = 0;
  // One byte more than stat promised, to see the end of the file; files of /proc promise none at all.
  for (;;) {
    if (filled == bytes.size())
      bytes.resize(std::min(bytes.size() + std::max<std::size_t>(bytes.size() / 2, 4096), limit + 1));
    const ssize_t count = ::read(file.number(), bytes.data() + filled, bytes.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw InputError(name, "cannot be read: " + error_text(errno));
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
    if (filled > limit) throw too_large();
  }
  bytes.resize(filled);
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

nlohmann::ordered_json output_list(const std::vector<OutputFile>& files) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const OutputFile& file : files)
    list.push_back({{"file", file.name}, {"bytes", file.bytes.size()}, {"sha256", sha256(file.bytes)}});
  return list;
}

}  // namespace fusee
