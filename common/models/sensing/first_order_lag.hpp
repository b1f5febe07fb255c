#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::sensing {

/// What follows a quantity with a lag of first order: the quantity goes in a straight line from call to call, to which
/// the answer is exact,
///
///   T dy/dt = x - y,   y[k] = x[k] - T r + (y[k-1] - x[k-1] + T r) e^(-dt/T),   r = (x[k] - x[k-1])/dt
///
/// It begins settled.
class FirstOrderLag {
 public:
  /// The answer at a sim time later than that of the call before; with a time constant of 0 it is the quantity.
  double follow(std::int64_t sim_time_ns, double quantity, double time_constant_s) {
    double answer = quantity;
    if (last_ && time_constant_s > 0.0) {
      const double dt_s = time::to_seconds(sim_time_ns - last_->sim_time_ns);
      const double steady = time_constant_s * (quantity - last_->quantity) / dt_s;
      answer = quantity - steady + (last_->answer - last_->quantity + steady) * std::exp(-dt_s / time_constant_s);
    }
    last_ = Last{sim_time_ns, quantity, answer};
    return answer;
  }

  /// The quantity has jumped to this right after the last call. Nothing before the first.
  void jump(double quantity) {
    if (last_) last_->quantity = quantity;
  }

  /// The answer stays; before the first call it begins with `quantity`.
  double hold(std::int64_t sim_time_ns, double quantity) {
    const double answer = last_ ? last_->answer : quantity;
    last_ = Last{sim_time_ns, answer, answer};
    return answer;
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp); the time constant is not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.last_);
  }

 private:
  struct Last {
    std::int64_t sim_time_ns;
    double quantity;
    double answer;

    template <class Self, class Visitor>
    static void state(Self& self, Visitor& visit) {
      visit(self.sim_time_ns, self.quantity, self.answer);
    }
  };

  std::optional<Last> last_;
};

}  // namespace inslab::sensing
