#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "inslab/referee/verify/table.hpp"

/// Whether a block of the verification can be fooled: faults are planted in what it puts to the test, and each of its
/// rows must be failed by at least one of them.
namespace inslab::verify {

using Tables = std::vector<Table>;

struct PlantedFault {
  std::string what;
  std::function<Tables()> with_it;  ///< the block, or those of its tables that look at the fault
};

/// "title | what the row is of": its cells before the first figure.
std::string name_of_row(const Table& table, const Row& row);

/// Runs the block sound and with each fault. Fails for a row that does not hold without a fault, for a fault that no
/// row sees, and, by name, for a row that no fault makes fail. Without `sound`, for blocks whose sound run another test
/// looks at, the rows are those of the runs with faults.
void expect_each_row_to_fail_by_some_fault(const std::function<Tables()>& sound,
                                           const std::vector<PlantedFault>& faults);

}  // namespace inslab::verify
