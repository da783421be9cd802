#include "nc/probing/dotted_parameters.hpp"

namespace fitgauge::probing {

machine::Vec3 angled_direction(const Arguments& arguments) {
  const auto axis = static_cast<std::size_t>(arguments.number(ParameterId::WordAxis));
  const auto [sine, cosine] = machine::sine_cosine(arguments.number(ParameterId::WordAngle));
  machine::Vec3 direction;
  direction[axis] = cosine;
  direction[(axis + 1) % 3] = sine;
  return direction;
}

}  // namespace fitgauge::probing
