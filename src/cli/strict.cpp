#include "cli/strict.h"

#include <algorithm>

namespace fusee::cli {

Option strict_option() {
  return {"--strict", "", "exit code 5 if there is a warning; files are\nwritten all the same"};
}

void apply_strict(const Arguments& arguments, Reply& reply) {
  if (!arguments.has("--strict") || reply.exit != Exit::done) return;
  const auto warnings =
      std::count_if(reply.diagnostics.begin(), reply.diagnostics.end(),
                    [](const Diagnostic& diagnostic) { return diagnostic.severity == Severity::warning; });
  if (warnings == 0) return;
  reply.exit = Exit::check_failed;
  reply.diagnostics.push_back(make_diagnostic(Severity::error, "exit code 5 because of " + std::to_string(warnings) +
                                                                   (warnings == 1 ? " warning" : " warnings") +
                                                                   " (--strict)"));
}

}  // namespace fusee::cli
