#pragma once

#include <optional>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/samples/credit.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::streams {

/// How long after the end of a run everybody stays for a service that was killed: until it has been started again, and
/// has what it lacks.
inline constexpr time::Nanoseconds kTimeToComeBack = std::chrono::seconds(30);

/// What the logger says of its log of a run: a credit for what the services say of themselves, 0 while the log is open,
/// 1 when it is closed and nobody has to stay for it.
inline Credit log_word(const RunId& run, bool is_closed) {
  Credit word;
  word.run_id = run;
  word.consumer = catalog::kTruthLogger;
  word.topic = catalog::kServiceStatus.name;
  word.next_sequence = is_closed ? 1 : 0;
  return word;
}

/// Whether there is still somebody to stay for at the end of a run. A service that ends has said its last word to the
/// logger; one that was killed meanwhile hears it only when it is back.
class LogWord {
 public:
  /// Takes a credit when it is the logger's word; false when it is another one.
  bool take(const Credit& credit) {
    if (credit.consumer != catalog::kTruthLogger || credit.topic != catalog::kServiceStatus.name) return false;
    newest_ = credit;
    return true;
  }
  /// Whether the logger has closed its log of this run, or has left it.
  bool is_closed(const RunId& run) const { return newest_ && newest_->run_id == run && newest_->next_sequence > 0; }

 private:
  std::optional<Credit> newest_;
};

}  // namespace inslab::streams
