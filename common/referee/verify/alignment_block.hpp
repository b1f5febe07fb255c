#pragma once

#include <cstdint>
#include <vector>

#include "inslab/referee/verify/subjects.hpp"
#include "inslab/referee/verify/table.hpp"

namespace inslab::verify {

/// Block 8 of the verification: half an hour, or `duration_s`, at rest of the lab's IMU
/// (config/profiles/imu/span100c.json) at 200 Hz and latitude 30.53 deg, aligned sample by sample, second by second and
/// as a whole; then the same run written as RAWIMUSXA lines of an ISA-100C, read back and aligned. Throws
/// files::WriteError when the folder for temporary files cannot be written.
std::vector<Table> alignment_tables(std::uint64_t seed, const Subjects& subjects = {}, int duration_s = 1800);

}  // namespace inslab::verify
