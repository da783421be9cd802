#include "nc/probing/object/object_cycle.hpp"

#include "log_templates.hpp"
#include "nc/machine/tolerance.hpp"
#include "nc/probing/alignment/rotation.hpp"
#include "nc/probing/log/measuring_log.hpp"
#include "nc/probing/measuring/measurement.hpp"
#include "nc/probing/preset/preset_cycle.hpp"

namespace fitgauge::probing {
namespace {

using gauging::Verdict;
using machine::Matrix3;
using namespace fmt::literals;

constexpr HtmlLog kObjectLog{"TCHPRAUTO.html", "Measuring log",
                             "Measuring log of touch-probe cycles",
                             "Deviations are from the middle of the tolerance."};

std::vector<MeasuredValue> values_of(const CycleDescriptor& cycle, const ObjectFound& found) {
  std::vector<MeasuredValue> values;
  for (std::size_t i = 0; i < 3 * found.points.size(); ++i) {
    const ObjectPoint& point = found.points[i / 3];
    const double towards = point.touched[i % 3];
    values.push_back({.characteristic = cycle.results[2 * i].meaning,
                      .role = towards == 0  ? ValueRole::Position
                              : towards < 0 ? ValueRole::ShaftSize
                                            : ValueRole::HoleSize,
                      .is_face = true,
                      .nominal = to_length(point.nominal[i % 3]),
                      .measured = to_length(point.measured[i % 3]),
                      .limits = point.limits.at(i % 3),
                      .result_q = static_cast<std::uint16_t>(950 + i),
                      .deviation_q = static_cast<std::uint16_t>(980 + i)});
  }
  values.insert(values.end(), found.sizes.begin(), found.sizes.end());
  return values;
}

CycleResult<void> log_object(const CycleContext& context, const std::vector<MeasuredValue>& values,
                             const std::vector<ObjectAngle>& angles, const ObjectStatus& status) {
  const auto text = [&](Length length) { return log_text(length, context.host.log_is_inch()); };
  std::string rows;
  const auto add = [&](std::string_view label, const std::array<std::string, 5>& cells,
                       std::string_view style) {
    rows += fmt::format(templates::object::row, "label"_a = label, "nominal"_a = cells[0],
                        "lower"_a = cells[1], "upper"_a = cells[2], "style"_a = style,
                        "measured"_a = cells[3], "deviation"_a = cells[4]);
  };
  for (const MeasuredValue& value : values) {
    const auto& limits = value.limits;
    add(value.characteristic,
        {text(value.nominal), limits ? text(limits->lower) : "", limits ? text(limits->upper) : "",
         text(value.measured), text(value.deviation())},
        ObjectStatus::of(value.verdict()).style);
  }
  for (const auto& [label, result, measured, deviation] : angles) {
    add(label, {fixed(measured - deviation, 4), "", "", fixed(measured, 4), fixed(deviation, 4)},
        "none");
  }
  const CycleDescriptor& cycle = context.descriptor();
  return add_section(
      context.host, kObjectLog,
      fmt::format(templates::object::section, "cycle"_a = cycle.number, "name"_a = cycle.name,
                  "when"_a = date_and_time(context.host), "style"_a = status.style,
                  "words"_a = status.words, "q183"_a = status.q183, "rows"_a = rows));
}

}  // namespace

ObjectStatus ObjectStatus::of(const std::optional<Verdict>& verdict) {
  if (!verdict) return {};
  if (*verdict == Verdict::Good) return {0, "good", "✓ Good"};
  if (*verdict == Verdict::Rework) return {1, "rework", "▲ Rework"};
  return {2, "scrap", "✗ Scrap"};
}

CycleResult<ObjectProbing> ObjectProbing::begin(const CycleContext& context) {
  context.host.set_q(183, -1, Unit::None);
  TRY(refuse_mirror_and_scaling(context.state().frames));
  if (context.number_or(1126, 0) != 0 && context.number_or(1121, 0) != 2) {
    return nc_error(1097,
                    "Q1126 without Q1121 = 2 would position the axes of a tilted plane: write "
                    "Q1126 = 0, and PLANE after the cycle");
  }
  auto motion = TRY(ProbingMotion::begin(context));
  return ObjectProbing(context, motion);
}

CycleResult<Nominal> ObjectProbing::size(int parameter) const {
  const std::string* text = context_.text(q(parameter));
  if (text == nullptr) return Nominal{to_length(context_.number(parameter))};
  return parse_nominal(*context_.descriptor().find(q(parameter)), *text,
                       context_.host.block_is_inch());
}

CycleResult<ObjectPoint> ObjectProbing::point(int first) const {
  ObjectPoint point;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto nominal = TRY(size(first + static_cast<int>(axis)));
    point.nominal[axis] = nominal.target.to_mm();
    point.limits.at(axis) = nominal.limits;
  }
  point.measured = point.nominal;
  return point;
}

CycleResult<std::vector<Contact>> ObjectProbing::touch(
    const std::vector<std::vector<Touch>>& objects) {
  const int mode = context_.whole(1125);
  auto& memory = context_.host.memory().extrusion;
  const Extrusion extrusion = memory.value_or(Extrusion{});
  const std::size_t times = extrusion.count + 1;
  if (!extrusion.is_modal) memory.reset();
  double height = mode < 0 ? -std::numeric_limits<double>::infinity() : context_.number(260);
  std::vector<Touch> touches;
  std::vector<Contact> means;
  for (const std::vector<Touch>& object : objects) {
    for (const Touch& touch : object) {
      if (std::abs(dot(extrusion.step, touch.direction)) >
          tolerance::kSquare * norm(extrusion.step))
        return nc_error(1016,
                        "cycle 1493 repeats the touch along its own probing direction: write an "
                        "axis across it in Q372 of 1493");
    }
    const bool is_first = touches.empty();
    for (std::size_t k = 0; k < object.size() * times; ++k) {
      Touch touch = object[k / times];
      if (k % times != 0 || (k == 0 && !is_first)) touch.transit = Transit::Straight;
      if (mode == 2) touch.transit = Transit::ClearanceHeight;
      if (touch.transit == Transit::ClearanceHeight) height = context_.number(260);
      touch.start = touch.start + extrusion.step * static_cast<double>(k % times);
      touches.push_back(std::move(touch));
    }
    if (mode != 1 && &object != &objects.back()) continue;
    const auto contacts = TRY(motion_.touch_all(touches, height));
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const Vec3 back = extrusion.step * static_cast<double>(k % times);
      if (k % times == 0) means.emplace_back();
      const double share = 1 / static_cast<double>(times);
      means.back().ball_centre =
          means.back().ball_centre + (contacts[k].ball_centre - back) * share;
      means.back().surface = means.back().surface + (contacts[k].surface - back) * share;
      if (times == 1 || (k + 1) % times != 0 || means.size() > 3) continue;
      double farthest = 0;
      for (std::size_t i = k + 1 - times; i <= k; ++i) {
        const Vec3 off = contacts[i].surface - means.back().surface;
        const Vec3 along = extrusion.step * static_cast<double>(i % times);
        farthest = std::max(farthest, std::abs(dot(off - along, touches[k].direction)));
      }
      set_lengths(context_.host, 969 + means.size(), {farthest});
    }
    touches.clear();
  }
  return means;
}

CycleResult<void> ObjectProbing::finish(const ObjectFound& found) {
  CycleHost& host = context_.host;
  const std::vector<MeasuredValue> values = values_of(context_.descriptor(), found);
  publish(host, values);
  for (const ObjectAngle& angle : found.angles) {
    const auto result = static_cast<std::uint16_t>(angle.result_q);
    host.set_q(result, to_angle(angle.measured), Unit::Angle);
    host.set_q(result + 30U, to_angle(angle.deviation), Unit::Angle);
  }
  const MeasuringRecord record = record_of(context_, {.values = values, .form = found.form});
  const ObjectStatus status = ObjectStatus::of(record.verdict);
  host.set_q(183, status.q183, Unit::None);
  TRY(log_object(context_, values, found.angles, status));
  host.record(record);
  TRY(transfer(found));
  if (status.stops(context_.whole(309))) return tolerance_stop(1072);
  return {};
}

CycleResult<void> ObjectProbing::transfer(const ObjectFound& found) {
  const WorkingPlane& plane = motion_.plane();
  const double rotation = context_.number_or(1121, 0);
  machine::PresetFrame turned = frames().preset();
  std::optional<MovedPoint> moved;
  if (const auto place = static_cast<std::size_t>(context_.whole(1120)); place > 0) {
    const std::size_t all = found.points.size();
    moved.emplace();
    for (std::size_t i = 0; i < all; ++i) {
      if (place <= all && i + 1 != place) continue;
      const double share = place <= all ? 1 : 1 / static_cast<double>(all);
      moved->nominal = moved->nominal + found.points[i].nominal * share;
      moved->measured = moved->measured + found.points[i].measured * share;
    }
  }
  if (rotation == 1) turned.basic_rotation_deg = turned_rotation(frames(), plane, found.turn);
  if (rotation == 2) {
    if (!found.turn_deg) return nc_error(1016, "Q1121 = 2: the table does not turn in that plane");
    const machine::Axis table = rotary_axis_around(plane.probe);
    const auto turn = TRY(table_angle(context_.state(), table, *found.turn_deg));
    if (context_.whole(1126) != 0) TRY(align_rotary_axis(context_, table, *found.turn_deg));
    turned.rotary_offsets_deg[machine::index(table) - 3] += to_angle(turn);
  }
  return correct_preset(context_, plane, turned, moved);
}

Vec3 object_direction(const Arguments& arguments) {
  const int axis = arguments.whole(372);
  Vec3 direction;
  direction[static_cast<std::size_t>(std::abs(axis) - 1)] = axis < 0 ? -1 : 1;
  return direction;
}

void add_line(ObjectFound& found, const ObjectProbing& probing, const Vec3& nominal,
              const Vec3& measured, bool is_level) {
  const WorkingPlane& plane = probing.motion().plane();
  const auto on_table = [&](const Vec3& along) {
    return plane.from_input(probing.frames().direction_to_machine(plane.to_input(along)));
  };
  const auto add = [&](const CycleOutput& result, const Vec3& from, const Vec3& to) {
    const auto angle = [&](const Vec3& v) {
      return machine::degrees(is_level ? std::atan2(v.y, v.x)
                                       : std::atan2(v.z, std::hypot(v.x, v.y)));
    };
    found.angles.push_back(
        {result.meaning, result.q, angle(to), std::remainder(angle(to) - angle(from), 360)});
  };
  add(kAngleResult, nominal, measured);
  add(kTableAngleResult, on_table(nominal), on_table(measured));
  found.turn = shortest_turn(nominal, measured);
  if (is_level) found.turn_deg = found.angles.front().deviation;
}

Vec3 face_behind(const Contact& contact, const Vec3& direction, const Vec3& normal,
                 double ball_radius) {
  return contact.ball_centre + direction * (ball_radius / std::abs(dot(normal, direction)));
}

Matrix3 shortest_turn(const Vec3& from, const Vec3& to) {
  const Vec3 axis = cross(unit(from), unit(to));
  const double sine = norm(axis);
  if (sine == 0) return {};
  return Matrix3::rotation(axis * (1 / sine),
                           machine::degrees(std::atan2(sine, dot(unit(from), unit(to)))));
}

CycleResult<void> check_dimensions(const Arguments& arguments) {
  for (const CycleParameter& parameter : arguments.descriptor().parameters) {
    const std::string* text = arguments.text(parameter.id);
    if (text == nullptr || parameter.kind != ValueKind::NumberOrText) continue;
    TRY(parse_nominal(parameter, *text, false));
  }
  return {};
}

}  // namespace fitgauge::probing
