#include "measurement/row_keeper.h"

namespace fusee::measurement {

void RowKeeper::add(Sample sample) {
  if (counter_++ % stride != 0) return;
  sample.after_break = after_break_ && !samples.empty();
  after_break_ = false;
  samples.push_back(sample);
  if (samples.size() >= most_) thin_out();
}

void RowKeeper::thin_out() {
  for (std::size_t i = 0; 2 * i < samples.size(); ++i) {
    const bool break_before = i > 0 && samples[2 * i - 1].after_break;
    samples[i] = samples[2 * i];
    samples[i].after_break = samples[i].after_break || break_before;
  }
  const bool drops_last = samples.size() % 2 == 0;
  after_break_ = drops_last && samples.back().after_break;
  samples.resize((samples.size() + 1) / 2);
  stride *= 2;
}

}  // namespace fusee::measurement
