#pragma once

#include <memory>
#include <string>

#include "inslab/formats/tables/columns.hpp"
#include "inslab/referee/predict/linear_model.hpp"

namespace inslab::predict {

/// F and Phi of each step of a motion as a file: CSV, or with a name that ends in .h5 or .hdf5 an HDF5 file whose group
/// is `linear_model`.
///
/// Columns: end_s, dt_s, where and how the IMU moves, C_nb, then F and Phi entry by entry, as "F.v_n.phi_e" (row,
/// column) with states r, v, phi along n, e, d in m, m/s, rad. Row k of Phi leads from the end of row k - 1 to its own.
class ModelFile {
 public:
  /// The file has its name when it is closed. Throws WriteError.
  explicit ModelFile(const std::string& path);
  ~ModelFile();
  ModelFile(const ModelFile&) = delete;
  ModelFile& operator=(const ModelFile&) = delete;

  void add(const LinearStep& step);
  void close();

 private:
  class Writer;
  std::unique_ptr<Writer> writer_;
  tables::Row row_;
};

}  // namespace inslab::predict
