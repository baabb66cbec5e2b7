#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>

#include "base/descriptor.h"
#include "fusee/base.h"

namespace fusee {
namespace {

std::string error_text(int code) { return std::error_code(code, std::generic_category()).message(); }

/// Throws InputError unless the request permits reading the file. Returns the size of a regular file, 0 for a pipe.
std::size_t demand_readable(const ReadRequest& request, const Descriptor& file) {
  const std::string name = request.path.string();
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) throw InputError(name, "cannot be read: " + error_text(errno));
  if (S_ISDIR(status.st_mode)) throw InputError(name, "is a directory", "name a file in it");
  if (!S_ISREG(status.st_mode) && !(request.pipes && S_ISFIFO(status.st_mode)))
    throw InputError(name, "is not a regular file", "write it to a file first");
  if (S_ISREG(status.st_mode) && static_cast<std::uintmax_t>(status.st_size) > request.limit)
    throw InputError(name, fmt::format("is larger than {} bytes", request.limit), "is it the right file?");
  return S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) : 0;
}

}  // namespace

FileAccess& disk() {
  static FileAccess files;
  return files;
}

void FileAccess::read(const ReadRequest& request, const TakeBlock& take) {
  const std::string name = request.path.string();
  // O_NONBLOCK: a pipe without a writer must not block. Where pipes are accepted, a writer exists.
  const int nonblocking = request.pipes ? 0 : O_NONBLOCK;
  const Descriptor file(::open(request.path.c_str(), O_RDONLY | O_CLOEXEC | nonblocking));
  if (!file.ok())
    throw InputError(name, "cannot be read: " + error_text(errno), errno == ENOENT ? "check the path" : "");
  const std::size_t size = demand_readable(request, file);
  // First touches of memory pages cost more than reading into them. The buffer is therefore no larger than the file,
  // and not zeroed. One extra byte detects the end of the file, or that it grew.
  constexpr std::size_t k_least_capacity = std::size_t{1} << 12, k_most_capacity = std::size_t{1} << 18;
  const std::size_t capacity = std::clamp(size + 1, k_least_capacity, k_most_capacity);
  const auto block = std::make_unique_for_overwrite<char[]>(capacity);
  std::size_t remaining = request.limit;
  for (;;) {
    const ssize_t count = ::read(file.number(), block.get(), capacity);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw InputError(name, "cannot be read: " + error_text(errno));
    if (count == 0) return;
    // Checked again here, because pipes and files of /proc report no size.
    if (static_cast<std::size_t>(count) > remaining)
      throw InputError(name, fmt::format("is larger than {} bytes", request.limit), "is it the right file?");
    remaining -= static_cast<std::size_t>(count);
    take({block.get(), static_cast<std::size_t>(count)});
  }
}

}  // namespace fusee
