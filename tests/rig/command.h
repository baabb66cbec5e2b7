/// \file
/// Options and scratch folder of the programs of this folder.
#pragma once

#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base.h"

namespace fusee::rig {

/// Stores the word after an option. False if the word is not valid for it.
template <typename Request>
using Reader = std::function<bool(Request&, const std::string&)>;

template <typename Request>
Reader<Request> text_into(std::string Request::*member) {
  return [=](Request& request, const std::string& text) { return request.*member = text, true; };
}
template <typename Request>
Reader<Request> texts_into(std::vector<std::string> Request::*member) {
  return [=](Request& request, const std::string& text) { return (request.*member).push_back(text), true; };
}
template <typename Request, typename Value>
Reader<Request> number_into(Value Request::*member, double least = 0) {
  return [=](Request& request, const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value >= least)) return false;
    request.*member = static_cast<Value>(value);
    return true;
  };
}

/// None for an unknown option, a missing word or an invalid one.
template <typename Request>
std::optional<Request> read_options(const std::vector<std::string>& words,
                                    const std::map<std::string, Reader<Request>>& options,
                                    const std::map<std::string, bool Request::*>& flags = {}) {
  Request request;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (const auto flag = flags.find(words[i]); flag != flags.end()) {
      request.*flag->second = true;
      continue;
    }
    const auto option = options.find(words[i]);
    if (option == options.end() || ++i == words.size() || !option->second(request, words[i])) return std::nullopt;
  }
  return request;
}

/// A temporary folder that its destructor removes.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& name) {
    std::string pattern = (std::filesystem::temp_directory_path() / (name + "_XXXXXX")).string();
    if (mkdtemp(pattern.data()) == nullptr) throw OutputError("cannot make a folder like " + pattern, "set TMPDIR");
    path_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A program's exit code: that of `run`, or 1 with the message of its exception on standard error.
inline int run_program(const char* name, int (*run)(const std::vector<std::string>&), int count, char** words) {
  try {
    return run({words + 1, words + count});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 1;
  }
}

}  // namespace fusee::rig
