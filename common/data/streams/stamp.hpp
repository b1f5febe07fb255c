#pragma once

#include "inslab/data/samples/stream_header.hpp"
#include "inslab/foundation/host/host.hpp"

namespace inslab::streams {

/// The sample with the clocks of this moment in its header: call right before it is written.
template <class Sample>
Sample& stamped(Sample& sample) {
  sample.header.publish_realtime_ns = host::realtime_now().count();
  sample.header.publish_monotonic_ns = host::monotonic_now().count();
  return sample;
}

}  // namespace inslab::streams
