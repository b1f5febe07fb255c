#pragma once

#include <string>
#include <vector>

#include "inslab/bus/service/service_options.hpp"
#include "inslab/formats/tables/picture.hpp"
#include "inslab/referee/verify/outage_score.hpp"
#include "inslab/referee/verify/table.hpp"

namespace inslab::study {

/// What is wanted of a block.
struct VerifyRequest {
  bool full = false;                ///< all seeds
  std::vector<std::string> files;   ///< the user's own, to be shown too
  verify::OutageTimes outages;      ///< of `navigation`
  bool over_dds = false;            ///< through the real processes, too
  service::NetworkOptions network;  ///< of these
  std::string picture;              ///< where the block's picture goes; empty: nowhere
};

/// One block of the verification: its name on the command line, what it shows, and the work.
struct Verification {
  const char* name;
  const char* purpose;
  std::vector<verify::Table> (*run)(const VerifyRequest& request);
  const char* files = nullptr;  ///< what --files takes; null: the block has no such option
  tables::Picture (*picture)() = nullptr;
  verify::Table (*over_dds)(const service::NetworkOptions& network, const verify::OutageTimes& outages) = nullptr;
};

/// The blocks of `inslab verify`.
const std::vector<Verification>& verifications();

/// The tables of a block.
std::vector<verify::Table> tables_of(const Verification& verification, const VerifyRequest& request);

}  // namespace inslab::study
