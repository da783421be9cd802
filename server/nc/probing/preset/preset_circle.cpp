#include "nc/probing/preset/preset_circle.hpp"

#include "nc/probing/measured_value.hpp"

namespace fitgauge::probing {

void publish_circle(const CycleContext& context, Side side, const ProbedCircle& probed) {
  const Circle& circle = probed.circle;
  CycleHost& host = context.host;
  set_length(host, 151, circle.centre.x);
  set_length(host, 152, circle.centre.y);
  set_length(host, 153, 2 * circle.radius);
  host.record(
      {.cycle = context.arguments.descriptor().number,
       .sizes = {{.characteristic = "Diameter",
                  .feature = side == Side::Inside ? iso286::Feature::Hole : iso286::Feature::Shaft,
                  .nominal = to_length(context.arguments.number(262)),
                  .measured = to_length(2 * circle.radius)}},
       .form = probed.form});
}

}  // namespace fitgauge::probing
