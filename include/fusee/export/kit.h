/// \file
/// What `fusee kit` leaves behind, as bytes. The same input gives the same bytes.
#pragma once

#include <string>
#include <vector>

#include "fusee/base/files.h"
#include "fusee/export/drawings.h"
#include "fusee/export/plan.h"
#include "fusee/export/product.h"
#include "fusee/kit/kit.h"

namespace fusee {

/// The rest of a test model, and the pulley that it is for.
struct KitProduct {
  Product pulley;  ///< of file, joint, curves and body; nothing of it was written
  KitPlan plan;
  PlanProduct bench;  ///< what to measure on it
  std::vector<Check> checks;
};

/// "base_plate.stl"
std::string kit_file_name(const KitPart& part, const std::string& ending);

/// A tendon to cut.
struct KitCut {
  Side side = Side::left;
  double between_knots = 0;  ///< from the pulley's knot to where it is held at the joint, taut, at home, mm
  double cut = 0;            ///< with both ends, whole 5 mm
};
std::vector<KitCut> kit_cuts(const KitProduct& product);

/// The parts that can be cut from sheets, nested flat: layers CUT_OUTER, CUT_INNER, ENGRAVE.
std::string kit_dxf(const KitProduct& product, DxfVersion version);
/// count,item,use
std::string bom_csv(const KitProduct& product);
/// The assembly page: pictures of each step, tendons, what to buy, the coupon, the measuring plan.
std::string kit_html(const KitProduct& product);
std::string kit_manifest_json(const KitProduct& product, const std::vector<OutputFile>& outputs);

}  // namespace fusee
