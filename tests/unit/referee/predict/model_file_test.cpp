#include "inslab/referee/predict/model_file.hpp"

#include <gmock/gmock.h>
#include <hdf5.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "inslab/referee/predict/response.hpp"

namespace inslab::predict {
namespace model_file_test {

using testing::HasSubstr;

/// A file that is gone with this object.
struct PassingFile {
  explicit PassingFile(const std::string& name) : path(testing::TempDir() + name) {}
  ~PassingFile() { std::filesystem::remove(path); }
  std::string path;
};

TEST(CsvModel, HasRowsWhosePhiMultiplyToThatOfTheSpan) {
  const PassingFile passing("model.csv");
  ResponseOptions options;
  options.latitude_deg = 30.0;
  options.hours = 0.5;
  options.step_s = 60.0;
  ModelFile model(passing.path);
  steps_at_rest(options, [&](const LinearStep& step) { model.add(step); });
  model.close();
  LinearStep whole;
  options.step_s = 1800.0;
  steps_at_rest(options, [&](const LinearStep& step) { whole = step; });

  std::ifstream file(passing.path);
  std::string line;
  std::getline(file, line);
  EXPECT_THAT(line, testing::StartsWith("end_s,dt_s,latitude_deg,longitude_deg,height_m,v_n_m_per_s.n,"));
  EXPECT_THAT(line, HasSubstr("C_nb.d.z,F.r_n.r_n,F.r_n.r_e"));
  EXPECT_THAT(line, testing::EndsWith(",Phi.phi_d.phi_e,Phi.phi_d.phi_d"));
  nav::Matrix9 product = nav::Matrix9::Identity(), F;
  int rows = 0;
  for (; std::getline(file, line); ++rows) {
    std::istringstream fields(line);
    std::vector<double> row;
    for (std::string field; std::getline(fields, field, ',');) row.push_back(std::stod(field));
    ASSERT_EQ(row.size(), 20U + 2U * 81U);
    using RowMajor = Eigen::Matrix<double, 9, 9, Eigen::RowMajor>;
    F = Eigen::Map<const RowMajor>(row.data() + 20);
    product = Eigen::Map<const RowMajor>(row.data() + 20 + 81) * product;
  }
  EXPECT_EQ(rows, 30);
  EXPECT_EQ(F, whole.F);
  // 1800 s: twelve terms leave (k t)^12/12! of the whole span's, 1e-4 of it.
  EXPECT_LT((product - whole.Phi).norm(), 1e-3 * whole.Phi.norm());
}

TEST(Hdf5Model, HasFAndPhiAsColumns) {
  const PassingFile passing("model.h5");
  ResponseOptions options;
  options.latitude_deg = 30.0;
  options.hours = 0.05;
  LinearStep last;
  ModelFile model(passing.path);
  steps_at_rest(options, [&](const LinearStep& step) {
    model.add(step);
    last = step;
  });
  model.close();
  const hid_t file = H5Fopen(passing.path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const auto end_of = [&](const char* name) {
    std::vector<double> values(18);  // 180 s
    const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(dataset);
    EXPECT_EQ(H5Sget_simple_extent_npoints(space), 18);
    EXPECT_GE(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
    H5Sclose(space);
    H5Dclose(dataset);
    return values.back();
  };
  EXPECT_EQ(end_of("linear_model/end_s"), 180.0);
  EXPECT_EQ(end_of("linear_model/F.v_n.phi_e"), last.F(3, 7));
  EXPECT_EQ(end_of("linear_model/Phi.r_n.v_n"), last.Phi(0, 3));
  H5Fclose(file);
}

}  // namespace model_file_test
}  // namespace inslab::predict
