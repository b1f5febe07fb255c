#pragma once

#include <functional>
#include <string>
#include <vector>

#include "inslab/formats/tables/picture.hpp"
#include "inslab/referee/predict/closed_forms.hpp"
#include "inslab/referee/predict/linear_model.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::predict {

/// The signed errors that one source makes, and the closed forms for a rest where the motion begins.
struct Response {
  ErrorSource source;
  std::vector<double> time_s;
  std::vector<ErrorState> errors;
  std::vector<ClosedForms> closed;
};

/// Errors of sources along the steps of one motion.
class Responses {
 public:
  Responses(const std::vector<ErrorSource>& sources, const nav::Gravity& gravity, Vertical vertical);

  void add(const LinearStep& step);

  const std::vector<Response>& list() const { return list_; }

 private:
  void begin(const LinearStep& first);

  nav::Gravity gravity_;
  Vertical vertical_;
  double begin_s_ = 0.0;
  std::vector<Response> list_;
  std::vector<ClosedFormsAtRest> closed_;  ///< one, once there is a place
  nav::Matrix3 C_nb_begin_ = nav::Matrix3::Identity();
};

/// Where and how the linear model is followed.
struct ResponseOptions {
  double latitude_deg = 0.0;  ///< at rest
  double height_m = 0.0;      ///< the same
  double hours = 4.0;         ///< the same
  double step_s = 0.0;        ///< 0: 10 s at rest, 0.2 s along a scenario
  std::uint32_t sensor_number = 0;
  bool hold_vertical = false;

  Vertical vertical() const { return hold_vertical ? Vertical::Held : Vertical::Free; }
};

using StepTaker = std::function<void(const LinearStep&)>;

/// Throws std::invalid_argument within 0.1 deg of a pole, where the longitude's states are not good for anything.
void steps_at_rest(const ResponseOptions& options, const StepTaker& take);

/// Runs a scenario. Throws files::ReadError for one that follows a live vehicle.
void steps_along(const scenario::LoadedScenario& loaded, const ResponseOptions& options, const StepTaker& take);

/// A dozen rows of each source, for people.
std::string table_text(const std::vector<Response>& responses);

/// All of it.
std::string csv_text(const std::vector<Response>& responses);

/// North, east and height of each source with the closed form beside it.
tables::Picture picture_of(const std::vector<Response>& responses, const std::string& title);

}  // namespace inslab::predict
