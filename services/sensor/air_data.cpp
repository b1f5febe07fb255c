#include "inslab/services/sensor/sensor_on_bus.hpp"
#include "inslab/sim/air_data_sensor.hpp"

int main(int argc, char** argv) { return inslab::sensor::run_sensor<inslab::catalog::AirData>(argc, argv); }
