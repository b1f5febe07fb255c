#pragma once

#include <string>

#include "inslab/data/samples/gnss_system.hpp"

/// Names of the random streams of satellites and receivers (noise/random/stream.hpp). A draw is a function of the seed,
/// the name and the epoch's index: it depends on no other satellite, signal or receiver, and on no order.
namespace inslab::observables {

/// What every receiver shares: "sky/G07/clock".
inline std::string sky_stream(const SatelliteId& satellite, const std::string& term) {
  return "sky/" + name_of(satellite) + "/" + term;
}

/// What is a receiver's own: "gnss0/clock".
inline std::string receiver_stream(std::uint32_t receiver, const std::string& term) {
  return "gnss" + std::to_string(receiver) + "/" + term;
}

/// And of one signal there: "gnss0/G07/1C/dll".
inline std::string signal_stream(std::uint32_t receiver, const SatelliteId& satellite, std::string_view rinex,
                                 const std::string& term) {
  return receiver_stream(receiver, name_of(satellite) + "/" + std::string(rinex) + "/" + term);
}

}  // namespace inslab::observables
