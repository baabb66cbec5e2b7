/// \file
/// The CSV of law = "table" or law = "torque", which goes where a changed mechanism file goes.
#pragma once

#include <optional>
#include <string>

#include "fusee/base/files.h"
#include "fusee/mechanism/file.h"

namespace fusee {

/// The table's name without its folder; none where the law is read from no table.
std::optional<std::string> law_table_name(const Mechanism& mechanism);

/// Its bytes under that name.
OutputFile law_table_copy(const MechanismFile& file);

/// `text`, which says what `file.mechanism` is, with the table beside it. The value of pulley.table, or of
/// pulley.torque_table, alone changes.
std::string with_table_beside(const std::string& text, const MechanismFile& file);

}  // namespace fusee
