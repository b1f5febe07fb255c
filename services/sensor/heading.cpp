#include "inslab/services/sensor/sensor_on_bus.hpp"
#include "inslab/sim/heading_sensor.hpp"

int main(int argc, char** argv) { return inslab::sensor::run_sensor<inslab::catalog::Heading>(argc, argv); }
