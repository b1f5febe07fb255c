#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab {
inline namespace samples {

/// Consecutive samples of one stream in one message (idl/block.idl): what lockstep sends, since single messages cannot
/// carry a hundred times real time.
template <class Sample>
struct Block {
  static constexpr std::size_t kMaxSamples = 64;

  std::vector<Sample> samples;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("samples").at_most(kMaxSamples), self.samples);
  }
};

}  // namespace samples
}  // namespace inslab
