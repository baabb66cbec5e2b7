#include "export/drawings/nesting.h"

#include <algorithm>
#include <numeric>

namespace fusee::formats {

std::vector<NestedPlace> nest(const std::vector<Vec2>& sizes, const Vec2& sheet, double gap) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&sizes](std::size_t a, std::size_t b) { return sizes[a].y() > sizes[b].y(); });

  std::vector<NestedPlace> places(sizes.size());
  Vec2 pen(gap, gap);  // lower left corner of the next rectangle
  double shelf = 0;    // height of the current shelf, given by its first rectangle
  int sheet_index = 0;
  for (const std::size_t i : order) {
    const Vec2& size = sizes[i];
    if (pen.x() > gap && pen.x() + size.x() + gap > sheet.x()) pen = {gap, pen.y() + shelf + gap};
    if (pen.y() > gap && pen.y() + size.y() + gap > sheet.y()) {
      pen = {gap, gap};
      ++sheet_index;
    }
    if (pen.x() == gap) shelf = size.y();
    const bool fits = size.x() + 2 * gap <= sheet.x() && size.y() + 2 * gap <= sheet.y();
    places[i] = {sheet_index, pen, fits};
    pen.x() += size.x() + gap;
  }
  return places;
}

int sheet_count(const std::vector<NestedPlace>& places) {
  int count = 1;
  for (const NestedPlace& place : places) count = std::max(count, place.sheet + 1);
  return count;
}

}  // namespace fusee::formats
