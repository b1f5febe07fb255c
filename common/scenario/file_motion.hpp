#pragma once

#include <string>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/samples/trajectory_limits.hpp"
#include "inslab/foundation/fields/field.hpp"
#include "inslab/scenario/vehicle_class.hpp"

namespace inslab::scenario {

/// How a motion is made from the rows of a file (math in docs/models.md).
enum class FileMethod : std::uint32_t {
  InverseMechanization,  ///< the increments that carry a strapdown algorithm from row to row
  Spline,                ///< smooth curves through the rows, differentiated
};

/// A motion that a file gives, row by row; sim time 0 is its first row. Which parameters it has depends on `method`.
struct FileMotion {
  static constexpr bool has_discriminator = true;

  FileMethod method = FileMethod::InverseMechanization;
  std::string path;
  std::string columns;
  std::string topic = catalog::kTruth.name;
  TrajectoryLimits limits;
  double position_feedback_per_s = 0.01;  ///< inverse_mechanization
  bool full_rotation_term = false;        ///< inverse_mechanization
  VehicleAttitude attitude_from_path;     ///< spline

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("method", "how the motion is made from the rows; other parameters depend on it").required(),
          self.method);
    visit(Field("path", "file of rows (docs/formats.md), relative to the scenario").at_most(4096).required(),
          self.path);
    visit(Field("columns", "names of the columns of a text that does not begin with them, with commas between")
              .at_most(1024),
          self.columns);
    visit(Field("topic", "of a log: truth or the solution of a navigation app; absent: inslab/truth").at_most(256),
          self.topic);
    visit(Field("limits", "beyond these the file is refused"), self.limits);
    if (self.method == FileMethod::InverseMechanization) {
      visit(Field("position_feedback_per_s", "share of the position's error that the velocity takes back").in(0.0, 1.0),
            self.position_feedback_per_s);
      visit(Field("full_rotation_term", "of the algorithm inverted: 1/6 dtheta x (dtheta x dv), as your app has it"),
            self.full_rotation_term);
    } else {
      visit(Field("attitude_from_path", "for rows without attitude"), self.attitude_from_path);
    }
  }
};

}  // namespace inslab::scenario

namespace inslab {

template <>
struct EnumNames<scenario::FileMethod> {
  static constexpr std::string_view type = "FileMethod";
  static constexpr std::string_view prefix = "FILE_METHOD_";
  static constexpr std::array<std::string_view, 2> values{"inverse_mechanization", "spline"};
};

}  // namespace inslab
