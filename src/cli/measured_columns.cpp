#include "cli/measured_columns.h"

#include <algorithm>

#include "fusee/base/diagnostics.h"

namespace fusee::cli {

Option column_option() {
  return {"--column", "ROLE=NAME",
          "the column of a role: alpha, theta, time, load,\ntemperature …; may be given several times", true};
}

MeasurementOptions columns_from(const Arguments& arguments) {
  MeasurementOptions options;
  std::vector<std::string> roles;
  for (const auto& [role, column] : column_roles()) roles.push_back(role);
  for (const std::string& text : arguments.texts("--column")) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
      throw UsageError("--column takes role=name; '" + text + "' is not of that form",
                       "for example: --column load=tau_out_Nm");
    }
    const std::string role = text.substr(0, equals);
    if (std::find(roles.begin(), roles.end(), role) == roles.end()) {
      const std::string nearest = nearest_word(role, roles);
      throw UsageError("--column: there is no role '" + role + "'",
                       nearest.empty() ? "roles: alpha, theta, time, load, temperature, tension1, tension2, cycle"
                                       : "did you mean '" + nearest + "'?");
    }
    options.columns[role] = text.substr(equals + 1);
  }
  return options;
}

}  // namespace fusee::cli
