#include "fusee/profile/advice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "base/run_async.h"
#include "fusee/base/text.h"
#include "fusee/mechanism/fields.h"
#include "fusee/profile/synthesis.h"

namespace fusee {
namespace {

/// A number of the file, or both ends of a range together, as one dial to turn.
struct Dial {
  std::string key;
  std::string symbol;
  std::string unit;
  double value = 0;
  double least = 0;
  double most = 0;
  /// How far a step of 100 % goes: the value's size, or a length of the joint for numbers near zero.
  double scale = 1;
  std::function<void(Mechanism&, double)> turn;
};

// A number of the pulley or its body is changed more readily than one of the joint.
constexpr double k_easier = 3.0;

std::optional<Dial> number_dial(const Mechanism& mechanism, const std::string& key) {
  const Field* field = find_field(key);
  if (field == nullptr || field->kind != FieldKind::number) return std::nullopt;
  Dial dial;
  dial.key = key;
  dial.symbol = field->symbol.empty() ? key : std::string(field->symbol);
  dial.unit = field->unit;
  dial.value = number_of(mechanism, *field);
  dial.least = field->least;
  dial.most = field->most;
  dial.scale = std::max(std::abs(dial.value), field->unit == "mm" && field->least < 0 ? 0.1 * mechanism.joint.R : 0.0);
  dial.turn = [field](Mechanism& changed, double value) { set_number(changed, *field, 0, value); };
  return dial;
}

/// Across and along of the attachments that the file gives.
std::vector<Dial> attachment_dials(const Mechanism& mechanism) {
  std::vector<Dial> all;
  for (const char* key : {"joint.attachment1_mm", "joint.attachment2_mm"}) {
    const Field* field = find_field(key);
    if (!field->is_set(DeclaredMechanism{mechanism})) continue;
    for (const int end : {0, 1}) {
      const std::string name = std::string(key) + (end == 0 ? "[0]" : "[1]");
      const double value = number_of(mechanism, *field, end);
      const auto turn = [field, end](Mechanism& changed, double to) { set_number(changed, *field, end, to); };
      all.push_back({name, name, "mm", value, field->least, field->most,
                     std::max(std::abs(value), 0.1 * mechanism.joint.R), turn});
    }
  }
  return all;
}

/// Both ends of a symmetric range together; else each end alone.
std::vector<Dial> range_dials(const Mechanism& mechanism) {
  const Field* field = find_field("joint.range_deg");
  if (field == nullptr) return {};
  const double low = number_of(mechanism, *field);
  const double high = number_of(mechanism, *field, 1);
  double least = field->least, most = field->most;
  if (mechanism.pulley.law == Law::table && !mechanism.pulley.rows.empty()) {
    // Past its rows a table says nothing.
    least = std::max(least, degrees(mechanism.pulley.rows.front().theta));
    most = std::min(most, degrees(mechanism.pulley.rows.back().theta));
  }
  if (mechanism.pulley.law == Law::torque && !mechanism.pulley.torque_rows.empty()) {
    least = std::max(least, degrees(mechanism.pulley.torque_rows.front().theta));
    most = std::min(most, degrees(mechanism.pulley.torque_rows.back().theta));
  }
  Dial both{"joint.range_deg", "the range", "deg", high, 0.5, std::min(most, -least), high, {}};
  both.turn = [field](Mechanism& changed, double value) {
    set_number(changed, *field, 0, -value);
    set_number(changed, *field, 1, value);
  };
  if (std::abs(low + high) < 1e-9) return {both};
  Dial lower{"joint.range_deg[0]", "the range's lower end", "deg", low, least, 0.0, std::abs(low), {}};
  lower.turn = [field](Mechanism& changed, double value) { set_number(changed, *field, 0, value); };
  Dial upper{"joint.range_deg[1]", "the range's upper end", "deg", high, 0.0, most, std::abs(high), {}};
  upper.turn = [field](Mechanism& changed, double value) { set_number(changed, *field, 1, value); };
  return {lower, upper};
}

std::vector<Dial> dials(const Mechanism& mechanism, const std::vector<std::string>& more_keys) {
  std::vector<std::string> keys{"joint.length_mm",  "guides.EB_mm", "guides.ED_mm",      "guides.OE_mm",
                                "guides.radius_mm", "pulley.EF_mm", "tendon.diameter_mm"};
  std::vector<Dial> all;
  const auto own = mechanism.pulley.law == Law::compensate ? number_dial(mechanism, "pulley.r1_mm")
                   : mechanism.pulley.law == Law::linear   ? number_dial(mechanism, "pulley.ratio")
                   : mechanism.pulley.motor_torque != 0    ? number_dial(mechanism, "pulley.motor_torque_Nmm")
                                                           : std::nullopt;
  if (own) {
    all.push_back(*own);
    all.back().scale *= k_easier;
  }
  for (const std::string& key : keys) {
    if (const auto dial = number_dial(mechanism, key)) all.push_back(*dial);
  }
  for (const std::string& key : more_keys) {
    auto dial = number_dial(mechanism, key);
    if (!dial) continue;
    dial->least = std::max(dial->least, 1e-3 * dial->value);
    dial->scale *= k_easier;
    all.push_back(*dial);
  }
  if (mechanism.sheath.is_there()) {
    // Where the pulley stands is nothing to its tendons; where the mouths do is.
    std::erase_if(all, [](const Dial& dial) { return dial.key == "pulley.EF_mm"; });
    for (const char* key : {"sheath.exit_across_mm", "sheath.exit_above_mm"})
      all.push_back(*number_dial(mechanism, key));
  }
  if (mechanism.joint.drum_radius > 0) all.push_back(*number_dial(mechanism, "joint.drum_radius_mm"));
  for (const Dial& dial : attachment_dials(mechanism)) all.push_back(dial);
  for (const Dial& dial : range_dials(mechanism)) all.push_back(dial);
  return all;
}

std::string change_text(const Dial& dial, double to) {
  const std::string amount = rounded(to, 3);
  if (dial.symbol == "the range") return "the range ±" + amount + "°";
  const std::string unit = dial.unit == "deg" ? "°" : dial.unit.empty() ? "" : " " + dial.unit;
  return dial.symbol + (to > dial.value ? " ≥ " : " ≤ ") + amount + unit;
}

/// `value` to three digits: nearest, and next towards `direction`.
std::array<double, 2> in_three_digits(double value, double direction) {
  if (value == 0) return {0, 0};
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2.0);
  const double scaled = value / unit;
  // Through the text: what is tried is what a reader of the text will write.
  const auto written = [](double number) { return std::stod(rounded(number, 3)); };
  return {written(std::round(scaled) * unit), written((direction > 0 ? std::ceil(scaled) : std::floor(scaled)) * unit)};
}

/// A dial and the way it is turned.
struct Turn {
  const Dial* dial;
  double direction;

  /// Downwards a number that cannot be negative is divided: a step of 100 % halves it, and none goes past all that is
  /// positive.
  double at(double step) const {
    const double by = step * dial->scale;
    const bool divided = direction < 0 && dial->least >= 0 && dial->value > 0;
    const double to = divided ? dial->value / (1.0 + by / dial->value) : dial->value + direction * by;
    return std::clamp(to, dial->least, dial->most);
  }
  /// A further step changes no more.
  bool ends_before(double step, double before) const { return at(step) == at(before); }
};

// A turn by 2 % of the number, and further each time; five times its size is another joint.
constexpr double k_first_step = 0.02;
constexpr double k_step_ratio = 2.4;
constexpr double k_last_step = 4.0;
// The border is halved down to this share of the number's size: three digits.
constexpr double k_border = 5e-4;
// So many changes are enough to choose from where a look tells all, and so many where each takes a whole making.
constexpr std::size_t k_enough = 3;
constexpr std::size_t k_enough_made = 2;
// No more makings are begun than these, and no more looks taken; then what is found is what there is.
constexpr int k_most_makings = 4;
constexpr int k_most_looks = 400;
// Pairs are tried among so many turns that help most.
constexpr std::size_t k_helpful = 4;

/// The search for one mechanism.
class Adviser {
 public:
  Adviser(const Mechanism& mechanism, const Judge& judge, const std::vector<std::string>& more_keys, std::size_t enough)
      : mechanism_(mechanism), judge_(judge), dials_(dials(mechanism, more_keys)), enough_(enough) {
    for (const Dial& dial : dials_) {
      if (!(dial.scale > 0)) continue;
      for (const double direction : {-1.0, 1.0}) turns_.push_back({&dial, direction});
    }
    learned_.resize(turns_.size());
  }

  /// All dials a step further at a time: the nearest changes are found first, and a dial that has one is left alone.
  std::vector<Change> alone() {
    std::vector<Change> found;
    std::vector<const Dial*> done;
    for (double step = k_first_step; step < k_last_step && found.size() < enough_ && may_look(); step *= k_step_ratio) {
      const std::vector<std::size_t> asked = asked_at(step, done);
      std::vector<Mechanism> there;
      for (const std::size_t t : asked) there.push_back(turned({turns_[t]}, {turns_[t].at(step)}));
      const std::vector<std::vector<Condition>> left = look_at(there);
      std::vector<Candidate> here;
      for (std::size_t i = 0; i < asked.size(); ++i) {
        Learned& learned = learned_[asked[i]];
        const double before = std::exchange(learned.step, step);
        const Turn& turn = turns_[asked[i]];
        if (!left[i].empty()) {
          learn(learned, left[i]);
        } else if (std::count(done.begin(), done.end(), turn.dial) == 0) {
          // A dial that is not proven here is not tried again: each proof is a whole making.
          done.push_back(turn.dial);
          here.push_back(Candidate{{turn}, before, step, step, 0, {}});
        }
      }
      sort_by_border(here, enough_ - found.size());
      for (const Candidate& proven : made_of(here, enough_ - found.size())) found.push_back(proven.changes().front());
    }
    return found;
  }

  /// Two dials turned by the same step, of those that help most alone: after alone() found nothing.
  std::vector<Change> together() {
    std::vector<std::size_t> helpful(turns_.size());
    std::iota(helpful.begin(), helpful.end(), std::size_t{0});
    std::stable_sort(helpful.begin(), helpful.end(),
                     [this](std::size_t a, std::size_t b) { return learned_[a].help > learned_[b].help; });
    helpful.resize(std::min(helpful.size(), k_helpful));
    double before = 0;
    for (double step = 2 * k_first_step; step < k_last_step; before = step, step *= k_step_ratio) {
      const std::vector<std::vector<Turn>> pairs = pairs_of(helpful);
      std::vector<Mechanism> there;
      for (const std::vector<Turn>& both : pairs) there.push_back(turned(both, values(both, step)));
      const std::vector<std::vector<Condition>> left = look_at(there);
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (!left[i].empty()) continue;
        const std::vector<Candidate> proven = made_of({Candidate{pairs[i], before, step, step, 0, {}}}, 1);
        if (!proven.empty()) return proven.front().changes();
        if (makings_left() == 0) return {};
      }
    }
    return {};
  }

 private:
  /// Turns of dials between a step that does not do and one that does, as near to each other as was looked for.
  struct Candidate {
    std::vector<Turn> turns;
    double bad = 0, good = 0, far = 0;
    int begun = 0;           ///< of the numbers to try: near the border, then where the search had stood
    std::vector<double> to;  ///< what is tried, or was last

    double distance(double step) const {
      const Turn& turn = turns.front();
      return std::abs(turn.at(step) - turn.dial->value) / turn.dial->scale;
    }
    bool is_at_border() const { return good - bad <= k_border; }
    std::vector<Change> changes() const {
      std::vector<Change> all;
      for (std::size_t i = 0; i < turns.size(); ++i) all.push_back(change(*turns[i].dial, to[i]));
      return all;
    }
  };
  /// What is known of a turn by now.
  struct Learned {
    double step = 0;  ///< that it was last looked at
    double help = 0;  ///< by how much it brought what fails down
    int waits = 0;    ///< steps that are left out before it is looked at again
    int waited = 0;   ///< that were, the last time
  };

  bool may_look() const { return looks_ < k_most_looks; }

  /// Of these turns, each with each of another dial; no more than may be looked at.
  std::vector<std::vector<Turn>> pairs_of(const std::vector<std::size_t>& turns) const {
    std::vector<std::vector<Turn>> pairs;
    for (std::size_t i = 0; i < turns.size(); ++i) {
      for (std::size_t j = i + 1; j < turns.size(); ++j) {
        const Turn &one = turns_[turns[i]], &other = turns_[turns[j]];
        if (one.dial != other.dial) pairs.push_back({one, other});
      }
    }
    pairs.resize(std::min(pairs.size(), static_cast<std::size_t>(std::max(0, k_most_looks - looks_))));
    return pairs;
  }
  /// None knows of another: where a look is dear, half of them on a thread of their own.
  std::vector<std::vector<Condition>> look_at(const std::vector<Mechanism>& changed) {
    std::vector<std::vector<Condition>> left(changed.size());
    const auto every_other = [&](std::size_t first) {
      for (std::size_t i = first; i < changed.size(); i += 2) left[i] = judge_.obstacles(changed[i]);
    };
    looks_ += static_cast<int>(changed.size());
    auto others = beside([&every_other] { every_other(1); }, judge_.made && changed.size() > 1);
    every_other(0);
    others.get();
    return left;
  }

  static std::vector<double> values(const std::vector<Turn>& turns, double step) {
    std::vector<double> all;
    for (const Turn& turn : turns) all.push_back(turn.at(step));
    return all;
  }
  Mechanism turned(const std::vector<Turn>& turns, const std::vector<double>& to) const {
    Mechanism changed = mechanism_;
    for (std::size_t i = 0; i < turns.size(); ++i) turns[i].dial->turn(changed, to[i]);
    return changed;
  }

  /// The turns that are looked at where all are turned by `step`.
  std::vector<std::size_t> asked_at(double step, const std::vector<const Dial*>& done) {
    std::vector<std::size_t> asked;
    for (std::size_t t = 0; t < turns_.size(); ++t) {
      if (std::count(done.begin(), done.end(), turns_[t].dial) > 0 || turns_[t].ends_before(step, learned_[t].step))
        continue;
      if (learned_[t].waits > 0) {
        --learned_[t].waits;
      } else {
        asked.push_back(t);
      }
    }
    asked.resize(std::min(asked.size(), static_cast<std::size_t>(k_most_looks - looks_)));
    return asked;
  }

  /// What the turn is good for where it is not enough. One that brings nothing down where a look is dear is asked again
  /// at longer and longer intervals: further on something else may give way.
  void learn(Learned& learned, const std::vector<Condition>& left) {
    if (first_.empty()) first_ = judge_.obstacles(mechanism_);
    learned.help = std::max(learned.help, weight(first_) - weight(left));
    if (!judge_.is_dear) return;
    std::vector<Condition> as_before = left;
    std::erase_if(as_before, [this](const Condition& condition) {
      return std::none_of(first_.begin(), first_.end(),
                          [&condition](const Condition& first) { return first.name == condition.name; });
    });
    learned.waited = weight(as_before) < weight(first_) ? 0 : learned.waited + 1;
    learned.waits = learned.waited;
  }
  /// A condition counts for itself and for what it fails by, in its limit's size.
  static double weight(const std::vector<Condition>& left) {
    double sum = 0;
    for (const Condition& condition : left) {
      const double gap = std::abs(condition.value - condition.limit);
      sum += 1.0 + (std::isfinite(gap) ? gap / (gap + std::abs(condition.limit) + 1.0) : 1.0);
    }
    return sum;
  }

  /// Each halfway back towards its border.
  void halve(const std::vector<Candidate*>& candidates) {
    std::vector<Mechanism> middles;
    for (const Candidate* candidate : candidates)
      middles.push_back(turned(candidate->turns, values(candidate->turns, 0.5 * (candidate->bad + candidate->good))));
    const std::vector<std::vector<Condition>> left = look_at(middles);
    for (std::size_t i = 0; i < left.size(); ++i) {
      Candidate& candidate = *candidates[i];
      (left[i].empty() ? candidate.good : candidate.bad) = 0.5 * (candidate.bad + candidate.good);
    }
  }

  /// In the order of their borders, as far as the first `wanted` go: the others are looked at no longer than they may
  /// be among these.
  void sort_by_border(std::vector<Candidate>& candidates, std::size_t wanted) {
    while (!candidates.empty()) {
      std::stable_sort(candidates.begin(), candidates.end(),
                       [](const Candidate& a, const Candidate& b) { return a.distance(a.good) < b.distance(b.good); });
      const Candidate& last = candidates[std::min(candidates.size(), wanted) - 1];
      std::vector<Candidate*> open;
      for (Candidate& candidate : candidates) {
        if (!candidate.is_at_border() && candidate.distance(candidate.bad) <= last.distance(last.good))
          open.push_back(&candidate);
      }
      if (open.empty() || !may_look()) return;
      halve(open);
    }
  }

  /// The next numbers to try, in three digits on the safe side; false where there are none.
  bool take_next(Candidate& candidate) {
    while (!candidate.is_at_border() && may_look()) halve({&candidate});
    while (candidate.begun < 2) {
      const double step = candidate.begun++ == 0 ? candidate.good : candidate.far;
      for (const std::size_t digit : {std::size_t{0}, std::size_t{1}}) {
        std::vector<double> to;
        bool is_new = true;
        for (const Turn& turn : candidate.turns) {
          to.push_back(in_three_digits(turn.at(step), turn.direction)[digit]);
          is_new =
              is_new && to.back() != turn.dial->value && to.back() >= turn.dial->least && to.back() <= turn.dial->most;
        }
        if (!is_new || !judge_.obstacles(turned(candidate.turns, to)).empty()) continue;
        if (to == candidate.to) break;  // and the other rounding differs by too little to be worth a making
        candidate.to = to;
        return true;
      }
    }
    return false;
  }

  /// The first `wanted` that are made, each with what was made. Two makings at a time; which are begun does not depend
  /// on how long each takes.
  std::vector<Candidate> made_of(std::vector<Candidate> candidates, std::size_t wanted) {
    std::vector<Candidate> proven;
    while (proven.size() < wanted && makings_left() > 0) {
      const std::size_t at_once = std::min({wanted - proven.size(), makings_left(), std::size_t{2}});
      std::vector<Candidate> tried, later;
      for (Candidate& candidate : candidates) {
        const bool is_full = tried.size() == at_once;
        if (is_full)
          later.push_back(std::move(candidate));
        else if (take_next(candidate))
          tried.push_back(std::move(candidate));
      }
      if (tried.empty()) break;
      const std::vector<bool> made = make(tried);
      candidates.clear();
      for (std::size_t i = 0; i < tried.size(); ++i) (made[i] ? proven : candidates).push_back(std::move(tried[i]));
      candidates.insert(candidates.end(), later.begin(), later.end());
    }
    return proven;
  }

  std::size_t makings_left() const {
    if (!judge_.made) return k_enough;
    const int left = k_most_makings - makings_;
    return static_cast<std::size_t>(std::max(0, judge_.makings ? std::min(left, judge_.makings()) : left));
  }

  std::vector<bool> make(const std::vector<Candidate>& candidates) {
    if (!judge_.made) return std::vector<bool>(candidates.size(), true);
    std::vector<std::future<bool>> begun;
    for (std::size_t i = 0; i < candidates.size(); ++i, ++makings_) {
      begun.push_back(
          beside([this, changed = turned(candidates[i].turns, candidates[i].to)] { return judge_.made(changed); },
                 i + 1 < candidates.size()));
    }
    std::vector<bool> made(candidates.size());
    for (std::size_t i = candidates.size(); i-- > 0;) made[i] = begun[i].get();  // the last one in this thread
    return made;
  }

  static Change change(const Dial& dial, double to) {
    return {dial.key, dial.value, to, dial.unit, change_text(dial, to)};
  }

  const Mechanism& mechanism_;
  const Judge& judge_;
  std::vector<Dial> dials_;
  std::vector<Turn> turns_;
  std::vector<Learned> learned_;  ///< of each turn
  std::vector<Condition> first_;
  std::size_t enough_;
  int looks_ = 0;
  int makings_ = 0;
};

}  // namespace

std::vector<Change> nearest_changes(const Mechanism& mechanism, const std::function<bool(const Mechanism&)>& possible,
                                    const std::vector<std::string>& more_keys) {
  const Judge judge{[&possible](const Mechanism& changed) {
    return possible(changed) ? std::vector<Condition>{} : std::vector<Condition>(1);
  }};
  return Adviser(mechanism, judge, more_keys, k_enough).alone();
}

Advice find_advice(const Mechanism& mechanism, const Judge& judge, const std::vector<std::string>& more_keys,
                   std::size_t known) {
  const std::size_t enough = judge.made ? k_enough_made : k_enough;
  if (known >= enough) return {};
  Adviser adviser(mechanism, judge, more_keys, enough - known);
  Advice advice{adviser.alone(), {}};
  if (advice.alone.empty()) advice.together = adviser.together();
  return advice;
}

std::string advice_sentence(const std::vector<Change>& changes) {
  std::string sentence;
  for (const Change& change : changes) sentence += (sentence.empty() ? "make " : ", or ") + change.text;
  return sentence;
}

}  // namespace fusee
