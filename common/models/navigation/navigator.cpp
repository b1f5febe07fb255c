#include "inslab/models/navigation/navigator.hpp"

namespace inslab::navigation {

std::optional<Navigator::Step> Navigator::step() {
  if (samples_.empty() || samples_.front().available_sim_time_ns > complete_up_to_ns_) return std::nullopt;
  const std::int64_t available_ns = samples_.front().available_sim_time_ns;
  const ImuSample sample = tag_time_.applied(samples_.front());
  samples_.pop_front();
  const auto later = observations_.upper_bound({available_ns, std::variant_npos, 0});
  for (auto each = observations_.begin(); each != later; ++each) filter_.add(tag_time_.applied(each->second));
  observations_.erase(observations_.begin(), later);
  return Step{sample.header.sequence_number, filter_.add(sample)};
}

}  // namespace inslab::navigation
