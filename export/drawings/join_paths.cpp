#include "export/drawings/join_paths.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "export/drawings/end_points.h"

namespace fusee::formats {
namespace {

/// Bound on comparisons of paths between the same two points.
constexpr std::size_t k_most_between = 16;

/// One end of an open path.
struct PathEnd {
  std::size_t path = 0;  ///< index
  bool last = false;     ///< at its last point, else at its first
};

class PathJoiner {
 public:
  explicit PathJoiner(std::vector<DrawingPath>& paths)
      : paths_(paths), used_(paths.size(), false), repeated_(paths.size(), false) {}

  std::vector<DrawingPath> join() {
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      if (paths_[i].closed || is_repeated(i)) continue;
      ends_of(i, false).push_back({i, false});
      ends_of(i, true).push_back({i, true});
    }
    std::vector<DrawingPath> chains;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      if (!used_[i]) chains.push_back(chain_of(i));
    }
    return chains;
  }

 private:
  /// True for an open path that repeats an earlier path of its layer, in either direction. A repeated path is not
  /// joined: with it, three ends would meet at its ends, and the chain of the earlier path would stay open there.
  bool is_repeated(std::size_t i) {
    const DrawingPath& path = paths_[i];
    if (path.in_space) return false;
    Layer& layer = layers_[path.layer];
    const auto ends = std::minmax({layer.points.number(path.points.front()), layer.points.number(path.points.back())});
    std::vector<std::size_t>& known = layer.between[ends];
    repeated_[i] = std::any_of(known.begin(), known.end(), [&](std::size_t k) { return is_same(paths_[k], path); });
    if (!repeated_[i] && known.size() < k_most_between) known.push_back(i);
    return repeated_[i];
  }

  static bool is_same(const DrawingPath& one, const DrawingPath& other) {
    const auto is_near = [](const Vec2& a, const Vec2& b) { return (a - b).norm() <= k_joined; };
    return one.points.size() == other.points.size() &&
           (std::equal(one.points.begin(), one.points.end(), other.points.begin(), is_near) ||
            std::equal(one.points.begin(), one.points.end(), other.points.rbegin(), is_near));
  }

  /// All ends that meet the `last` (or first) end of a path, including that end.
  std::vector<PathEnd>& ends_of(std::size_t path, bool last) {
    const Polygon& points = paths_[path].points;
    Layer& layer = layers_[paths_[path].layer];
    const std::size_t node = layer.points.number(last ? points.back() : points.front());
    if (node >= layer.ends.size()) layer.ends.resize(node + 1);
    return layer.ends[node];
  }

  /// The end that continues `path` at its `last` end, if there is exactly one.
  std::optional<PathEnd> continuation(std::size_t path, bool last) {
    const std::vector<PathEnd>& ends = ends_of(path, last);
    if (ends.size() != 2) return std::nullopt;
    const PathEnd& other = ends[0].path == path && ends[0].last == last ? ends[1] : ends[0];
    return used_[other.path] ? std::nullopt : std::optional<PathEnd>(other);
  }

  /// Extends `chain`, which ends with the `last` end of path `i`.
  void extend(Polygon& chain, std::size_t i, bool last) {
    while (const auto end = continuation(i, last)) {
      const Polygon& points = paths_[end->path].points;
      if (end->last) {
        chain.insert(chain.end(), points.rbegin() + 1, points.rend());
      } else {
        chain.insert(chain.end(), points.begin() + 1, points.end());
      }
      used_[end->path] = true;
      i = end->path;
      last = !end->last;
    }
  }

  DrawingPath chain_of(std::size_t i) {
    DrawingPath path = std::move(paths_[i]);
    paths_[i].points = {path.points.front(), path.points.back()};  // extend() still looks up the ends
    paths_[i].layer = path.layer;
    used_[i] = true;
    if (path.closed || repeated_[i]) return path;
    extend(path.points, i, true);
    std::reverse(path.points.begin(), path.points.end());
    extend(path.points, i, false);
    std::reverse(path.points.begin(), path.points.end());
    close_where_ends_meet(path);
    return path;
  }

  struct Layer {
    EndPoints points;
    std::vector<std::vector<PathEnd>> ends;  ///< by number of the point
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>>
        between;  ///< paths, by the numbers of both ends
  };
  std::vector<DrawingPath>& paths_;
  std::vector<bool> used_, repeated_;
  std::map<std::string, Layer> layers_;
};

}  // namespace

void close_where_ends_meet(DrawingPath& path) {
  if (path.points.size() <= 2 || (path.points.front() - path.points.back()).norm() > k_joined) return;
  path.closed = true;
  path.points.pop_back();
}

std::vector<DrawingPath> joined_paths(std::vector<DrawingPath> paths) { return PathJoiner(paths).join(); }

}  // namespace fusee::formats
