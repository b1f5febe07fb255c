#pragma once

#include <string>

#include "inslab/foundation/fields/field.hpp"

namespace inslab {
inline namespace samples {

/// What a consumer of a stream wants next (idl/control.idl): it needs nothing before `next_sequence` again.
struct Credit {
  RunId run_id;
  std::string consumer;  ///< the service's name
  std::uint32_t consumer_number = 0;
  std::string topic;
  std::uint64_t next_sequence = 0;
  bool resend = false;  ///< send again from next_sequence on: the consumer is new, restarted, or has a gap

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("run_id"), self.run_id);
    visit(Field("consumer").at_most(32).key(), self.consumer);
    visit(Field("consumer_number").key(), self.consumer_number);
    visit(Field("topic").key(), self.topic);
    visit(Field("next_sequence"), self.next_sequence);
    visit(Field("resend"), self.resend);
  }
};

}  // namespace samples
}  // namespace inslab
