#include "inslab/referee/predict/model_file.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "inslab/formats/tables/csv_writer.hpp"
#include "inslab/formats/tables/hdf5_writer.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::predict {
namespace {

constexpr std::array<const char*, 9> kStates{"r_n", "r_e", "r_d", "v_n", "v_e", "v_d", "phi_n", "phi_e", "phi_d"};
constexpr std::array<const char*, 3> kUnits{"m", "m/s", "rad"};

void add_matrix(std::vector<tables::Column>& columns, const std::string& name, const std::string& per) {
  for (std::size_t row = 0; row < kStates.size(); ++row) {
    for (std::size_t column = 0; column < kStates.size(); ++column) {
      columns.push_back({name + "." + kStates[row] + "." + kStates[column],
                         "(" + std::string(kUnits[row / 3]) + ")/(" + kUnits[column / 3] + ")" + per});
    }
  }
}

std::vector<tables::Column> columns() {
  std::vector<tables::Column> list{
      {"end_s", "s"}, {"dt_s", "s"}, {"latitude_deg", "deg"}, {"longitude_deg", "deg"}, {"height_m", "m"}};
  for (const char* axis : {"n", "e", "d"}) list.push_back({std::string("v_n_m_per_s.") + axis, "m/s"});
  for (const char* axis : {"n", "e", "d"}) list.push_back({std::string("f_n_m_per_s2.") + axis, "m/s^2"});
  for (const char* row : {"n", "e", "d"}) {
    for (const char* column : {"x", "y", "z"}) list.push_back({std::string("C_nb.") + row + "." + column, "1"});
  }
  add_matrix(list, "F", "/s");
  add_matrix(list, "Phi", "");
  return list;
}

bool is_hdf5(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return extension == ".h5" || extension == ".hdf5";
}

template <class Matrix>
void add_entries(tables::Row& row, const Matrix& matrix) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.emplace_back(matrix(i, j));
  }
}

}  // namespace

class ModelFile::Writer {
 public:
  explicit Writer(const std::string& path) {
    if (is_hdf5(path)) {
      table_ = &hdf5_.emplace(path).add_table("linear_model", "", "", columns());
    } else {
      csv_.emplace(path, columns());
    }
  }
  void row(const tables::Row& cells) {
    if (csv_) csv_->row(cells);
    if (table_ != nullptr) table_->row(cells);
  }
  void close() {
    if (csv_) csv_->close();
    if (hdf5_) hdf5_->close();
  }

 private:
  std::optional<tables::CsvWriter> csv_;
  std::optional<tables::Hdf5Writer> hdf5_;
  tables::Hdf5Writer::Table* table_ = nullptr;
};

ModelFile::ModelFile(const std::string& path) : writer_(std::make_unique<Writer>(path)) {}
ModelFile::~ModelFile() = default;

void ModelFile::add(const LinearStep& step) {
  row_.clear();
  for (const double cell : {step.end_s, step.dt_s, step.position.latitude_rad * units::kDegPerRad,
                            step.position.longitude_rad * units::kDegPerRad, step.position.height_m}) {
    row_.emplace_back(cell);
  }
  add_entries(row_, step.v_n);
  add_entries(row_, step.f_n);
  add_entries(row_, step.C_nb);
  add_entries(row_, step.F);
  add_entries(row_, step.Phi);
  writer_->row(row_);
}

void ModelFile::close() { writer_->close(); }

}  // namespace inslab::predict
