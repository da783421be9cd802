#include "nc/probing/cycles.hpp"
#include "nc/probing/object/object_cycle.hpp"
#include "nc/probing/touch/part_here.hpp"

namespace fitgauge::probing::cycle_1400_1434 {

using namespace parameter;

constexpr std::array kEnd = join(kObject, std::array{transfer_position(1)});
constexpr std::array kUndercut =
    join(std::array{length(1118, "Start further back from the face", 0)}, kEnd);
constexpr std::array kFace = join(kPoint1, std::array{kObjectDirection});
constexpr std::array kWidth =
    join(kPoint1, std::array{dimension(1113, "Width of the slot or ridge"),
                             choice(1115, "Geometry: 0 slot, 1 ridge", 0, 1, 0),
                             angle(1114, "Angle of rotation", 360, 0)});
constexpr std::array k1400 = join(kFace, kEnd);
constexpr std::array k1404 = join(kWidth, kEnd);
constexpr std::array k1430 = join(kFace, kUndercut);
constexpr std::array k1434 = join(kWidth, kUndercut);
constexpr std::array k1493{
    kObjectDirection, choice(1145, "Number of repetitions", 1, 99),
    CycleParameter{.id = q(1146), .meaning = "Length", .unit = Unit::Length, .range = {-99, 99}},
    choice(1149, "Effect: 0 next cycle, 1 until the program ends", 0, 1, 0)};

constexpr auto kFaceResults = object_results<1>(std::array<CycleOutput, 0>{});
constexpr auto kWidthResults =
    object_results<1>(std::array{CycleOutput{968, "Width", Unit::Length}});

CycleResult<void> probe_face(const CycleContext& context) {
  const auto direction = TRY(object_direction(context.arguments));
  auto probing = TRY(ObjectProbing::begin(context));
  auto point = TRY(probing.point(1100));
  const auto contacts = TRY(probing.touch({{probing.towards(point.nominal, direction)}}));
  point.touch(contacts.front().surface, direction);
  return probing.finish({.points = {point}});
}

CycleResult<void> probe_width(const CycleContext& context) {
  auto probing = TRY(ObjectProbing::begin(context));
  auto point = TRY(probing.point(1100));
  const auto width = TRY(probing.size(1113));
  const bool ridge = context.arguments.whole(1115) == 1;
  const auto [sine, cosine] = machine::sine_cosine(context.arguments.number(1114));
  const Vec3 along{cosine, sine, 0};
  const Vec3 outwards = ridge ? -along : along;
  const double half = width.target.to_mm() / 2;
  const double offset = half + (ridge ? 1 : -1) * probing.start_distance();
  const Vec3 start = along * std::max(0.0, offset);
  const auto touched =
      probing.touch({{{.start = point.nominal + start, .direction = outwards},
                      {.start = point.nominal - start,
                       .direction = -outwards,
                       .transit = ridge ? Transit::ClearanceHeight : Transit::Straight}}});
  if (!touched) {
    const std::size_t axis = std::abs(cosine) > std::abs(sine) ? 0 : 1;
    auto place = width_place(ridge ? Side::Outside : Side::Inside, point.nominal, axis, 2 * half);
    place.other_side = ridge ? "Q1115 = 0" : "Q1115 = 1";
    return with_part(touched.error(), context, probing.motion().plane(), std::span(&place, 1));
  }
  const auto& contacts = *touched;
  const double first = dot(contacts.front().surface - point.nominal, along);
  const double second = dot(contacts.back().surface - point.nominal, along);
  point.measured = point.nominal + along * ((first + second) / 2);
  return probing.finish({.points = {point},
                         .sizes = {{.characteristic = "Width",
                                    .role = ridge ? ValueRole::ShaftSize : ValueRole::HoleSize,
                                    .nominal = width.target,
                                    .measured = to_length(first - second),
                                    .limits = width.limits,
                                    .result_q = 968,
                                    .deviation_q = 998}}});
}

CycleResult<void> extrude(const CycleContext& context) {
  const Arguments& arguments = context.arguments;
  const auto direction = TRY(object_direction(arguments));
  const Vec3 step = direction * (arguments.number(1146) / arguments.number(1145));
  context.host.memory().extrusion =
      Extrusion{step, static_cast<std::size_t>(arguments.whole(1145)), arguments.whole(1149) == 1};
  return {};
}

constinit const TouchProbeCycle kCycle1400 =
    object_cycle(1400, "POSITION PROBING", k1400, kFaceResults, {1042}, probe_face);
constinit const TouchProbeCycle kCycle1404 =
    object_cycle(1404, "PROBE SLOT/RIDGE", k1404, kWidthResults, {}, probe_width);
constinit const TouchProbeCycle kCycle1430 =
    object_cycle(1430, "PROBE POSITION OF UNDERCUT", k1430, kFaceResults, {1042}, probe_face);
constinit const TouchProbeCycle kCycle1434 =
    object_cycle(1434, "PROBE SLOT/RIDGE UNDERCUT", k1434, kWidthResults, {}, probe_width);
constinit const TouchProbeCycle kCycle1493 =
    cycle(1493, "EXTRUSION PROBING", CycleKind::Other, k1493, {}, {1042}, extrude,
          "Cycles 1400 to 1434 repeat each touch that often, evenly over the length, and "
          "measure the mean. Q970 to Q972 are the largest distances from it, of the first "
          "three touches, along their probing direction. No motion.");

}  // namespace fitgauge::probing::cycle_1400_1434
