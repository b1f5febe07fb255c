#include "inslab/services/inslab/study/verifications.hpp"

#include <spdlog/spdlog.h>

#include "inslab/referee/verify/alignment_block.hpp"
#include "inslab/referee/verify/allan_block.hpp"
#include "inslab/referee/verify/closed_loop_block.hpp"
#include "inslab/referee/verify/gnss.hpp"
#include "inslab/referee/verify/increments_block.hpp"
#include "inslab/referee/verify/navigation.hpp"
#include "inslab/referee/verify/propagation.hpp"
#include "inslab/referee/verify/raw_gnss_block.hpp"
#include "inslab/referee/verify/realism.hpp"
#include "inslab/referee/verify/trajectory_block.hpp"
#include "inslab/referee/verify/vibration_block.hpp"
#include "inslab/services/inslab/study/outages_over_dds.hpp"

namespace inslab::study {

namespace {

void say(const std::string& what) { spdlog::info(what); }

}  // namespace

const std::vector<Verification>& verifications() {
  static const std::vector<Verification> list{
      {"trajectory", "Truth of motion tables against an independent solution (thesis table 4-1)",
       [](const VerifyRequest&) { return verify::verify_trajectory(); }},
      {"closed-loop", "From a file through IMU and mechanization back to the file (thesis table 4-2)",
       [](const VerifyRequest& request) { return verify::closed_loop(request.files); },
       "trajectory files with velocity and attitude to show too"},
      {"alignment", "Static coarse alignment with the lab's IMU, direct and from NovAtel lines (lab report)",
       [](const VerifyRequest&) { return verify::alignment_tables(1); }},
      {"allan", "Random errors of the IMU by Allan variance (thesis tables 4-4 to 4-7)",
       [](const VerifyRequest& request) { return verify::allan_tables(request.full, say); }},
      {"increments", "Order of the error of mechanized increments, and of rate times interval",
       [](const VerifyRequest&) { return verify::increments(60.0); }},
      {"gnss", "Errors of the receivers and the lever arm of their antenna (thesis tables 4-8, 4-9)",
       [](const VerifyRequest& request) { return verify::gnss(request.full); }},
      {"navigation", "Drift in GNSS outages and the filter's honesty (thesis tables 4-10 to 4-13)",
       [](const VerifyRequest& request) { return verify::navigation(request.full, request.outages); }, nullptr, nullptr,
       outages_over_dds},
      {"realism", "What a real set has besides, one cause at a time, in the thesis's outages",
       [](const VerifyRequest& request) {
         verify::OutageRuns runs;
         runs.seeds = request.full ? 20 : 1;
         return std::vector<verify::Table>{verify::realism_table(runs)};
       }},
      {"propagation", "How errors of inertial navigation grow, against closed forms and the linear model (lecture)",
       [](const VerifyRequest& request) { return verify::propagation(request.full); }, nullptr,
       verify::propagation_picture},
      {"vibration", "Increments, coning, sculling and spectra of vibration",
       [](const VerifyRequest& request) { return verify::vibration_tables(request.full); }},
      {"raw_gnss", "Broadcast orbits and ranges against precise orbits and a commercial simulator",
       [](const VerifyRequest& request) {
         return verify::raw_gnss_tables(request.files.empty() ? std::string() : request.files.front());
       },
       "the folder of the reference data (docs/verification.md)"},
  };
  return list;
}

std::vector<verify::Table> tables_of(const Verification& verification, const VerifyRequest& request) {
  std::vector<verify::Table> tables = verification.run(request);
  if (request.over_dds) tables.push_back(verification.over_dds(request.network, request.outages));
  return tables;
}

}  // namespace inslab::study
