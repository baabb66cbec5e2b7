/// \file
/// The outputs of `fusee kit`, as bytes. The same input gives the same bytes.
#pragma once

#include <string>
#include <vector>

#include "fusee/base/files.h"
#include "fusee/export/drawings.h"
#include "fusee/export/plan.h"
#include "fusee/export/product.h"
#include "fusee/kit/kit.h"

namespace fusee {

/// A test rig, and the pulley that it is for.
struct KitProduct {
  Product pulley;  ///< file, joint, curves and body, not written
  KitPlan plan;
  PlanProduct bench;  ///< the measurements to be made on it
  std::vector<Check> checks;
};

/// File name such as "base_plate.stl".
std::string kit_file_name(const KitPart& part, const std::string& ending);

/// Length of a tendon to be cut.
struct KitCut {
  Side side = Side::left;
  double between_knots = 0;  ///< from the pulley's knot to its fastening at the joint, taut, at home, mm
  double cut = 0;            ///< including both ends, in whole 5 mm
};
std::vector<KitCut> kit_cuts(const KitProduct& product);

/// The parts that can be cut from sheets, nested flat: layers CUT_OUTER, CUT_INNER, ENGRAVE.
std::string kit_dxf(const KitProduct& product, DxfVersion version);
/// The columns count,item,use.
std::string bom_csv(const KitProduct& product);
/// The assembly page: pictures of each step, tendons, parts to buy, the coupon, the measuring plan.
std::string kit_html(const KitProduct& product);
std::string kit_manifest_json(const KitProduct& product, const std::vector<OutputFile>& outputs);

}  // namespace fusee
