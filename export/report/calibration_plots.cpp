#include "export/report/calibration_plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "base/text.h"
#include "export/report/plot.h"
#include "fusee/transmission.h"

namespace fusee::formats {
namespace {

constexpr int k_bins = 48;                  // bins of the range of α
constexpr std::size_t k_most_points = 240;  // points of a plot, for each direction
constexpr std::size_t k_most_runs = 40;     // runs with plots of their own
constexpr std::size_t k_few_runs = 6;       // up to this number, plots are wide

using Residuals = std::vector<std::vector<double>>;

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool has_width() const { return high > low; }
};

// ---- runs in one direction ------------------------------------------------------------------------------------------

/// Calls visit(sample index) for the whole strokes of a run in one direction, and after_stroke() at the end of each.
void for_each_sample(
    const measurement::Run& run, int direction, const std::function<void(std::size_t)>& visit,
    const std::function<void()>& after_stroke = [] {}) {
  for (const measurement::Stroke& stroke : run.strokes) {
    if (stroke.direction != direction || stroke.partial) continue;
    for (std::size_t i = stroke.first; i <= stroke.last && i < run.samples.size(); ++i) visit(i);
    after_stroke();
  }
}

/// Number of leading runs that have a residual for every sample.
std::size_t runs_with_residuals(const CalibrationProduct& product) {
  const calibration::Calibration& calibration = product.calibration;
  std::size_t count = 0;
  while (count < product.measurement.runs.size() && count < calibration.residuals_before.size() &&
         count < calibration.residuals_after.size() &&
         calibration.residuals_before[count].size() == product.measurement.runs[count].samples.size() &&
         calibration.residuals_after[count].size() == product.measurement.runs[count].samples.size()) {
    ++count;
  }
  return count;
}

Extent alpha_extent(const measurement::Measurement& measurement) {
  Extent extent;
  for (const measurement::Run& run : measurement.runs) {
    for (const measurement::Sample& sample : run.samples) extent.include(degrees(sample.alpha));
  }
  return extent;
}

/// Mean over the samples in each bin of α, deg. NaN before the first and after the last bin with samples.
using Profile = std::array<double, k_bins>;

class ProfileSum {
 public:
  explicit ProfileSum(const Extent& alpha) : alpha_(alpha) {}

  void add(const measurement::Run& run, const std::vector<double>& residuals, int direction) {
    for_each_sample(run, direction, [&](std::size_t i) {
      if (!std::isfinite(residuals[i])) return;
      const double bin = (degrees(run.samples[i].alpha) - alpha_.low) / (alpha_.high - alpha_.low) * k_bins;
      const auto k = static_cast<std::size_t>(std::clamp(bin, 0.0, k_bins - 1.0));
      sums_[k] += degrees(residuals[i]);
      counts_[k] += 1;
    });
  }

  /// The mean in each bin. Fast runs leave bins empty: these are interpolated linearly.
  Profile mean() const {
    Profile profile;
    profile.fill(k_gap);
    std::size_t last = k_bins;  // the last bin with samples; k_bins: none yet
    for (std::size_t k = 0; k < k_bins; ++k) {
      if (counts_[k] == 0) continue;
      profile[k] = sums_[k] / counts_[k];
      for (std::size_t between = last + 1; last < k_bins && between < k; ++between) {
        profile[between] = profile[last] + (profile[k] - profile[last]) * static_cast<double>(between - last) /
                                               static_cast<double>(k - last);
      }
      last = k;
    }
    return profile;
  }

 private:
  Extent alpha_;
  Profile sums_{}, counts_{};
};

Profile profile_of(const measurement::Run& run, const std::vector<double>& residuals, int direction,
                   const Extent& alpha) {
  ProfileSum sum(alpha);
  sum.add(run, residuals, direction);
  return sum.mean();
}

double bin_middle(const Extent& alpha, std::size_t k) {
  return alpha.low + (alpha.high - alpha.low) * (static_cast<double>(k) + 0.5) / k_bins;
}

PlotSeries profile_series(const Profile& profile, int direction, const Extent& alpha) {
  PlotSeries series{direction > 0 ? "α growing" : "α falling", direction > 0 ? Ink::p1 : Ink::p2, {}};
  for (std::size_t k = 0; k < k_bins; ++k) {
    if (std::isfinite(profile[k])) series.points.emplace_back(bin_middle(alpha, k), profile[k]);
  }
  return series;
}

/// Every stroke of a run in one direction, thinned.
PlotSeries stroke_series(const measurement::Run& run, int direction, const std::function<double(std::size_t)>& value) {
  PlotSeries series{"", direction > 0 ? Ink::p1 : Ink::p2, {}, true};
  const std::size_t step = run.samples.size() / (2 * k_most_points) + 1;
  for_each_sample(
      run, direction,
      [&](std::size_t i) {
        if (i % step == 0) series.points.emplace_back(degrees(run.samples[i].alpha), value(i));
      },
      [&] { series.points.emplace_back(k_gap, k_gap); });
  return series;
}

std::string single_figure_html(const Plot& plot) {
  return "<div class=\"single\">" + inline_svg(plot_figure(plot)) + "</div>\n";
}

/// Range of all residuals, zero included: the same axis for every plot of the page.
Extent residual_extent(const CalibrationProduct& product) {
  Extent extent{0, 0};
  for (std::size_t r = 0; r < runs_with_residuals(product); ++r) {
    for (const Residuals* residuals : {&product.calibration.residuals_before, &product.calibration.residuals_after}) {
      for (const int direction : {1, -1}) {
        for_each_sample(product.measurement.runs[r], direction,
                        [&](std::size_t i) { extent.include(degrees((*residuals)[r][i])); });
      }
    }
  }
  return extent;
}

// ---- the map --------------------------------------------------------------------------------------------------------

constexpr int k_shades = 8;            // for each sign
constexpr double k_row_height = 11;    // px
constexpr double k_run_gap = 3;        // px
constexpr double k_right_margin = 16;  // px

/// The mean residuals of all runs, before or after: two rows per run.
struct ResidualMap {
  std::vector<std::array<Profile, 2>> rows;  ///< [run][0: α grows, 1: falls]
};

ResidualMap map_of(const CalibrationProduct& product, const Residuals& residuals, const Extent& alpha) {
  ResidualMap map;
  for (std::size_t r = 0; r < runs_with_residuals(product); ++r) {
    const measurement::Run& run = product.measurement.runs[r];
    map.rows.push_back({profile_of(run, residuals[r], 1, alpha), profile_of(run, residuals[r], -1, alpha)});
  }
  return map;
}

double largest(const ResidualMap& map) {
  double most = 0;
  for (const auto& run : map.rows) {
    for (const Profile& profile : run) {
      for (const double value : profile) {
        if (std::isfinite(value)) most = std::max(most, std::abs(value));
      }
    }
  }
  return most;
}

std::string rectangle(double x, double y, double width, double height) {
  return "M" + svg_number(x) + " " + svg_number(y) + "h" + svg_number(width) + "v" + svg_number(height) + "h" +
         svg_number(-width) + "z";
}

std::string shade_path(int shade, const std::string& data) {
  if (data.empty()) return "";
  return "<path class=\"" + std::string(shade > 0 ? "warm" : "cold") + "\" fill-opacity=\"" +
         svg_number(std::abs(shade) / static_cast<double>(k_shades)) + "\" d=\"" + data + "\"/>";
}

/// −k_shades … k_shades; 0: too small to be shown. `colour_limit`: the residual that has the last shade, deg.
int shade_of(double value, double colour_limit) {
  return std::isfinite(value) && colour_limit > 0 ? static_cast<int>(std::lround(value / colour_limit * k_shades)) : 0;
}

/// Keeps the end of a long name, where names of runs differ.
std::string short_name(const std::string& name, std::size_t max_length) {
  return name.size() <= max_length || max_length < 4 ? name : "…" + name.substr(name.size() - max_length + 1);
}

std::string map_label(const measurement::Run& run, const std::string& load_unit) {
  if (!run.has_load) return short_name(run.name, 28);
  return short_name(run.name, 16) + ", " + readable_rounded(run.mean_load, 2) +
         (load_unit.empty() ? "" : " " + load_unit);
}

/// The shades from cold to warm, and three numbers under them.
std::string map_scale(double left, double top, double width, double colour_limit) {
  std::string svg;
  const double cell = width / (2 * k_shades + 1);
  for (int shade = -k_shades; shade <= k_shades; ++shade) {
    svg += shade_path(shade, shade == 0 ? "" : rectangle(left + cell * (shade + k_shades), top, cell, 8));
  }
  svg += svg_words("soft tiny", {left, top + 22}, readable_rounded(-colour_limit, 2) + "°") +
         svg_words("soft tiny middle", {left + 0.5 * width, top + 22}, "0");
  return svg + svg_words("soft tiny end", {left + width, top + 22}, "+" + readable_rounded(colour_limit, 2) + "°");
}

/// Labels stand to the left of their rows, or above them in a narrow column. px.
struct MapLayout {
  double width = 460;
  double left = 182;  ///< where the rows begin
  double above = 0;   ///< height of a label above its rows
};

Figure draw_map(const CalibrationProduct& product, const ResidualMap& map, const std::string& title,
                double colour_limit, const Extent& alpha, const MapLayout& layout) {
  constexpr double top = 30;
  const auto [width, left, above] = layout;
  const double cell = (width - left - k_right_margin) / k_bins;
  std::array<std::string, 2 * k_shades + 1> data;
  Figure figure{width, 0, title, svg_words("heading", {2, 17}, title), {}};
  double y = top;
  for (std::size_t r = 0; r < map.rows.size(); ++r, y += 2 * k_row_height + k_run_gap) {
    y += above;
    figure.body += svg_words(above > 0 ? "tiny" : "tiny end",
                             above > 0 ? Vec2(left, y - 4) : Vec2(left - 22, y + k_row_height + 4),
                             map_label(product.measurement.runs[r], product.measurement.load_unit));
    if (above > 0) {
      const double right = width - k_right_margin, end = y + 2 * k_row_height;
      figure.body += svg_path("frame", {{left, y}, {right, y}, {right, end}, {left, end}}, true);
    }
    for (std::size_t d = 0; d < 2; ++d) {
      const double row = y + static_cast<double>(d) * k_row_height;
      figure.body += svg_words("soft tiny end", {left - 6, row + 9}, d == 0 ? "↑" : "↓");
      for (std::size_t k = 0; k < k_bins; ++k) {
        const int shade = shade_of(map.rows[r][d][k], colour_limit);
        // A hair wider than the cell, so that no line shows between two.
        if (shade != 0)
          data[static_cast<std::size_t>(shade + k_shades)] +=
              rectangle(left + cell * static_cast<double>(k), row, cell + 0.15, k_row_height + 0.1);
      }
    }
  }
  for (int shade = -k_shades; shade <= k_shades; ++shade)
    figure.body += shade_path(shade, data[static_cast<std::size_t>(shade + k_shades)]);
  if (above == 0)
    figure.body += svg_path(
        "frame",
        {{left, top}, {width - k_right_margin, top}, {width - k_right_margin, y - k_run_gap}, {left, y - k_run_gap}},
        true);
  const double middle = left + 0.5 * (width - k_right_margin - left);
  figure.body += svg_words("soft tiny", {left, y + 12}, readable(alpha.low, 0) + "°") +
                 svg_words("tiny middle", {middle, y + 12}, "motor angle α");
  figure.body += svg_words("soft tiny end", {width - k_right_margin, y + 12}, readable(alpha.high, 0) + "°");
  figure.body += map_scale(left, y + 24, width - k_right_margin - left, colour_limit);
  figure.height = y + 52;
  return figure;
}

Figure map_figure(const CalibrationProduct& product, const ResidualMap& map, const std::string& title,
                  double colour_limit, const Extent& alpha) {
  Figure figure = draw_map(product, map, title, colour_limit, alpha, {});
  figure.narrow.push_back(draw_map(product, map, title, colour_limit, alpha, {280, 22, 17}));
  return figure;
}

// ---- load and speed -------------------------------------------------------------------------------------------------

enum class Factor { load, speed };

/// A dot of the plot: the mean of a run in one direction.
struct MeanResidual {
  double level = 0;     ///< mean load in the log's unit, or motor speed in deg/s
  double residual = 0;  ///< deg
  int direction = 1;
};

std::optional<MeanResidual> mean_residual(const measurement::Run& run, const std::vector<double>& residuals,
                                          int direction, Factor factor) {
  double level = 0, sum = 0, count = 0;
  for_each_sample(run, direction, [&](std::size_t i) {
    if (!std::isfinite(residuals[i])) return;
    level += factor == Factor::load ? run.samples[i].load : degrees(run.speed);
    sum += degrees(residuals[i]);
    count += 1;
  });
  if (count == 0 || !std::isfinite(level)) return std::nullopt;
  return MeanResidual{level / count, sum / count, direction};
}

std::vector<MeanResidual> mean_residuals(const CalibrationProduct& product, const Residuals& residuals, Factor factor) {
  std::vector<MeanResidual> means;
  for (std::size_t r = 0; r < runs_with_residuals(product); ++r) {
    const measurement::Run& run = product.measurement.runs[r];
    if (factor == Factor::load ? !run.has_load : !run.has_time) continue;
    for (const int direction : {1, -1}) {
      if (const auto mean = mean_residual(run, residuals[r], direction, factor)) means.push_back(*mean);
    }
  }
  return means;
}

Plot level_plot(const std::vector<MeanResidual>& means, const std::string& title, const PlotAxis& x,
                const Extent& residual) {
  Plot plot{title, x, {"mean residual", "°", residual.low, residual.high, 1e-3}, {}, {}, {}};
  plot.series = {{"α growing", Ink::p1, {}}, {"α falling", Ink::p2, {}}};
  for (const MeanResidual& mean : means)
    plot.marks.push_back({{mean.level, mean.residual}, "", mean.direction > 0 ? Ink::p1 : Ink::p2});
  plot.height = 240;
  return plot;
}

std::string level_pair(const CalibrationProduct& product, Factor factor) {
  const std::vector<MeanResidual> before = mean_residuals(product, product.calibration.residuals_before, factor);
  const std::vector<MeanResidual> after = mean_residuals(product, product.calibration.residuals_after, factor);
  Extent level, residual{0, 0};
  for (const auto* means : {&before, &after}) {
    for (const MeanResidual& mean : *means) {
      level.include(mean.level);
      residual.include(mean.residual);
    }
  }
  const double size = std::max(std::abs(level.low), std::abs(level.high));
  constexpr double k_least_variation = 0.05;  // of the largest level; below it the runs have one level
  if (!level.has_width() || level.high - level.low < k_least_variation * size) return "";
  const double margin = 0.04 * (level.high - level.low);
  const std::string& unit = product.measurement.load_unit;
  const bool by_load = factor == Factor::load;
  const PlotAxis axis{by_load ? "load, mean in that direction" : "motor speed", by_load ? unit : "°/s",
                      level.low - margin, level.high + margin};
  const std::string title = by_load ? "Over load" : "Over speed";
  return in_div(plot_figure(level_plot(before, title + ": before", axis, residual))) +
         in_div(plot_figure(level_plot(after, title + ": after", axis, residual)));
}

// ---- run by run -----------------------------------------------------------------------------------------------------

double rms_of(const measurement::Run& run, const std::vector<double>& residuals) {
  double squares = 0, count = 0;
  for (const int direction : {1, -1}) {
    for_each_sample(run, direction, [&](std::size_t i) {
      if (!std::isfinite(residuals[i])) return;
      squares += residuals[i] * residuals[i];
      count += 1;
    });
  }
  return count > 0 ? degrees(std::sqrt(squares / count)) : k_gap;
}

Figure run_figure(const measurement::Run& run, const std::vector<double>& residuals, const std::string& title,
                  const Extent& extent, const Extent& alpha, bool wide) {
  Plot plot{title,
            {"motor angle α", "°", alpha.low, alpha.high, 1e-6},
            {wide ? "measured less model" : "residual", "°", extent.low, extent.high, 1e-3},
            {},
            {},
            {}};
  const auto value = [&](std::size_t i) { return degrees(residuals[i]); };
  for (const int direction : {1, -1}) plot.series.push_back(stroke_series(run, direction, value));
  for (const int direction : {1, -1})
    plot.series.push_back(profile_series(profile_of(run, residuals, direction, alpha), direction, alpha));
  if (!wide) plot.width = 270;
  plot.height = wide ? 240 : 200;
  return plot_figure(plot);
}

}  // namespace

std::string run_words(const measurement::Run& run, const std::string& load_unit) {
  std::string words = run.name;
  if (run.has_load)
    words += ", load " + readable_rounded(run.mean_load, 3) + (load_unit.empty() ? "" : " " + load_unit);
  if (run.has_time) words += ", " + readable_rounded(degrees(run.speed), 3) + " °/s";
  return words;
}

std::string residual_map_html(const CalibrationProduct& product) {
  const Extent alpha = alpha_extent(product.measurement);
  if (!alpha.has_width() || runs_with_residuals(product) == 0) return "";
  const ResidualMap before = map_of(product, product.calibration.residuals_before, alpha);
  const ResidualMap after = map_of(product, product.calibration.residuals_after, alpha);
  const double colour_limit = std::max({largest(before), largest(after), 1e-3});
  return "<p class=\"lead\">Every run at a glance: mean of measured less model at each place of α, with α growing (↑) "
         "and falling (↓). Differences between loads indicate stretch or friction, between ↑ and ↓ lost motion, "
         "between columns geometry.</p><div "
         "class=\"plots\">" +
         in_div(map_figure(product, before, "Before", colour_limit, alpha)) +
         in_div(map_figure(product, after, "After, same colours", colour_limit, alpha)) + "</div>";
}

std::string residual_levels_html(const CalibrationProduct& product) {
  const std::string html = level_pair(product, Factor::load) + level_pair(product, Factor::speed);
  return html.empty() ? ""
                      : "<h3>Over load and speed</h3><p class=\"lead\">Each dot is a run in one direction.</p><div "
                        "class=\"plots\">" +
                            html + "</div>";
}

std::string residual_runs_html(const CalibrationProduct& product) {
  const Extent extent = residual_extent(product), alpha = alpha_extent(product.measurement);
  const std::size_t judged = runs_with_residuals(product), shown = std::min(judged, k_most_runs);
  if (shown == 0 || !alpha.has_width()) return "";
  const bool wide = shown <= k_few_runs;
  std::string html;
  for (std::size_t r = 0; r < shown; ++r) {
    const measurement::Run& run = product.measurement.runs[r];
    const auto& before = product.calibration.residuals_before[r];
    const auto& after = product.calibration.residuals_after[r];
    html += "<div><h3>" + safe_text(run_words(run, product.measurement.load_unit)) + " <small>rms " +
            readable(rms_of(run, before), 3) + "° → " + readable(rms_of(run, after), 3) +
            "°</small></h3><div class=\"pair\">" + in_div(run_figure(run, before, "Before", extent, alpha, wide)) +
            in_div(run_figure(run, after, "After", extent, alpha, wide)) + "</div></div>";
  }
  std::string lead =
      "<h3>Run by run</h3><p class=\"lead\">Thick: the mean at each place; thin: every stroke. All on the same axis.";
  if (judged > shown)
    lead += " The first " + std::to_string(shown) + " of " + std::to_string(judged) + " runs; the table below has all.";
  return lead + "</p><div class=\"runs" + (wide ? "" : " many") + "\">" + html + "</div>";
}

std::string residual_html(const CalibrationProduct& product) {
  const Extent alpha = alpha_extent(product.measurement);
  const std::size_t judged = runs_with_residuals(product);
  if (judged == 0 || !alpha.has_width()) return "";
  const double floor = degrees(product.calibration.noise.rms);
  Plot plot{"Residual of all runs",
            {"motor angle α", "°", alpha.low, alpha.high, 1e-6},
            {"mean residual after", "°", {}, {}, 1e-3},
            {},
            {},
            {}};
  for (const int direction : {1, -1}) {
    ProfileSum sum(alpha);
    for (std::size_t r = 0; r < judged; ++r)
      sum.add(product.measurement.runs[r], product.calibration.residuals_after[r], direction);
    plot.series.push_back(profile_series(sum.mean(), direction, alpha));
  }
  if (floor > 0) plot.limits = {{floor, ""}, {-floor, ""}};
  plot.width = 560;
  plot.height = 260;
  return single_figure_html(plot);
}

std::string discrepancy_html(const calibration::DiscrepancyComponent& part) {
  if (part.alpha.size() < 2) return "";
  PlotSeries course{"", Ink::third, {}};
  for (std::size_t i = 0; i < part.alpha.size(); ++i)
    course.points.emplace_back(degrees(part.alpha[i]), degrees(part.theta[i]));
  Plot plot{"Unmodelled, by " + part.factor,
            {"motor angle α", "°", {}, {}, 1e-6},
            {"largest error", "°", {}, {}, 1e-3},
            {course},
            {},
            {}};
  plot.width = 560;
  plot.height = 220;
  return single_figure_html(plot);
}

std::string curve_html(const CalibrationProduct& product) {
  const calibration::EmpiricalCurve& curve = product.calibration.curve;
  if (!curve.used) return "";
  PlotSeries up{"α growing", Ink::p1, {}}, down{"α falling", Ink::p2, {}};
  for (std::size_t i = 0; i < curve.alpha.size(); ++i) {
    up.points.emplace_back(degrees(curve.alpha[i]), degrees(curve.up[i]));
    down.points.emplace_back(degrees(curve.alpha[i]), degrees(curve.down[i]));
  }
  Plot plot{"Empirical curve in compensation.csv, without a cause",
            {"motor angle α", "°", {}, {}, 1e-6},
            {"measured less model", "°", {}, {}, 1e-3},
            {up, down},
            {},
            {}};
  plot.width = 560;
  plot.height = 240;
  return single_figure_html(plot);
}

std::string compensation_html(const CalibrationProduct& product) {
  const std::vector<correction::CompensationRow>& table = product.correction.table;
  const Mechanism& mechanism = product.file.mechanism;
  if (table.size() < 2) return "";
  const std::optional<transmission::Transmission> law =
      mechanism.transmission ? std::nullopt : std::optional<transmission::Transmission>(mechanism);
  if (law && law->dead_centre()) return "";
  PlotSeries up{"from below", Ink::p1, {}}, down{"from above", Ink::p2, {}};
  double constant = 0;
  for (const correction::CompensationRow& row : table) {
    const double declared = law ? law->alpha(row.theta) : row.theta * mechanism.transmission->ratio;
    up.points.emplace_back(degrees(row.theta), degrees(row.alpha_up - declared));
    down.points.emplace_back(degrees(row.theta), degrees(row.alpha_down - declared));
    constant += (up.points.back().y() + down.points.back().y()) / (2.0 * static_cast<double>(table.size()));
  }
  // If the zero of the joint is free, the table has an arbitrary constant. It would dwarf everything else in the plot.
  for (PlotSeries* series : {&up, &down}) {
    for (Vec2& point : series->points) point.y() -= law ? 0 : constant;
  }
  Plot plot{"compensation.csv against the target motion",
            {"joint angle θ", "°", {}, {}, 1e-3},
            {law ? "added to α" : "added to α, less a constant", "°", {}, {}, 1e-2},
            {up, down},
            {},
            {}};
  plot.width = 560;
  plot.height = 260;
  return single_figure_html(plot);
}

std::string logged_html(const measurement::Measurement& measurement) {
  std::string html;
  const std::size_t shown = std::min<std::size_t>(measurement.runs.size(), k_few_runs);
  for (std::size_t r = 0; r < shown; ++r) {
    const measurement::Run& run = measurement.runs[r];
    if (run.samples.empty()) continue;
    Plot plot{run_words(run, measurement.load_unit),
              {"motor angle α", "°", {}, {}, 1},
              {"joint angle θ", "°", {}, {}, 1},
              {{"", Ink::main, {}}},
              {},
              {}};
    const std::size_t step = run.samples.size() / k_most_points + 1;
    for (std::size_t i = 0; i < run.samples.size(); i += step)
      plot.series[0].points.emplace_back(degrees(run.samples[i].alpha), degrees(run.samples[i].theta));
    plot.height = 240;
    html += in_div(plot_figure(plot));
  }
  return html.empty() ? "" : "<div class=\"plots\">" + html + "</div>";
}

}  // namespace fusee::formats
