#pragma once

/// The models of every kind of sensor.

#include "inslab/sim/air_data_sensor.hpp"
#include "inslab/sim/barometer_sensor.hpp"
#include "inslab/sim/gnss_sensor.hpp"
#include "inslab/sim/heading_sensor.hpp"
#include "inslab/sim/imu_sensor.hpp"
#include "inslab/sim/magnetometer_sensor.hpp"
#include "inslab/sim/odometer_sensor.hpp"
