#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/foundation/time/rate.hpp"
#include "inslab/models/imu/imu_model.hpp"
#include "inslab/models/trajectory/smooth_motion.hpp"
#include "inslab/models/trajectory/truth_model.hpp"
#include "inslab/referee/verify/mechanization.hpp"
#include "inslab/sim/run_sink.hpp"

/// What the verification puts to the test. A block takes its subjects as an argument, the product's own unless said
/// otherwise: a test hands in one with a fault in it and demands that the rows see it.
namespace inslab::verify {

/// The truth of a motion table.
using TruthOf = std::function<std::unique_ptr<trajectory::TruthModel>(const scenario::Trajectory& trajectory,
                                                                      const time::Rate& rate)>;
std::unique_ptr<trajectory::TruthModel> product_truth(const scenario::Trajectory& trajectory, const time::Rate& rate);

/// The truth of a file's rows by inverse mechanization.
using InverseOf = std::function<std::unique_ptr<trajectory::TruthModel>(
    const std::shared_ptr<const TrajectoryFile>& file, const nav::Gravity& gravity, const time::Rate& rate)>;
std::unique_ptr<trajectory::TruthModel> product_inverse(const std::shared_ptr<const TrajectoryFile>& file,
                                                        const nav::Gravity& gravity, const time::Rate& rate);

/// The curve through a file's rows.
using CurveOf = std::function<trajectory::SmoothMotion(const TrajectoryFile& file)>;
trajectory::SmoothMotion product_curve(const TrajectoryFile& file);

/// An IMU: what it puts out for the interval that ends at a truth sample.
using Imu = std::function<std::optional<imu::ImuModel::Output>(const TruthState& truth)>;
using ImuOf = std::function<Imu(const imu::ImuModel::Setup& setup)>;
Imu product_imu(const imu::ImuModel::Setup& setup);

/// A RAWIMUSXA line of an ISA-100C for every sample.
using ImuLines = std::function<std::string(const ImuSample& sample)>;
using ImuLinesOf = std::function<ImuLines()>;
ImuLines product_lines();

/// A whole run of all sensors, from time `start` on.
using Simulation =
    std::function<void(const scenario::LoadedScenario& scenario, const time::GpsTime& start, sim::RunSink& sink)>;
void product_simulation(const scenario::LoadedScenario& scenario, const time::GpsTime& start, sim::RunSink& sink);

struct Subjects {
  TruthOf truth = product_truth;
  InverseOf inverse = product_inverse;
  CurveOf curve = product_curve;
  ImuOf imu = product_imu;
  ImuLinesOf lines = product_lines;
  MechanizationOf mechanization = product_mechanization;
  Simulation simulation = product_simulation;
};

}  // namespace inslab::verify
