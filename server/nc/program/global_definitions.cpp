#include "nc/program/global_definitions.hpp"

#include <algorithm>
#include <array>

#include "nc/probing/parameters.hpp"

namespace fitgauge::interpreter {
namespace {

namespace usual = probing::parameter;
using probing::CycleDescriptor;
using probing::CycleParameter;
using probing::Unit;
using probing::ValueKind;

constexpr CycleParameter global_feed(int number, std::string_view meaning) {
  return {.id = probing::q(number),
          .meaning = meaning,
          .unit = Unit::Feed,
          .kind = ValueKind::NumberOrMax,
          .range = {0, usual::kLongest}};
}

constexpr CycleParameter global_number(int number, std::string_view meaning, double least,
                                       double most) {
  return {.id = probing::q(number), .meaning = meaning, .range = {least, most}};
}

constexpr std::array kGeneral{
    usual::length(200, "Set-up clearance"), usual::length(204, "2nd set-up clearance"),
    global_feed(253, "Feed for pre-positioning"), global_feed(208, "Feed for retraction")};
constexpr std::array kDrilling{usual::length(256, "Retraction for chip breaking"),
                               global_number(210, "Dwell time at the top", 0, 3600),
                               global_number(211, "Dwell time at the depth", 0, 3600)};
constexpr std::array kPocketMilling{global_number(370, "Path overlap factor", 0, 1.999),
                                    usual::choice(351, "Climb 1 or up-cut -1", -1, 1),
                                    usual::choice(366, "Type of plunging", 0, 2)};
constexpr std::array kContourMilling{
    global_number(2, "Path overlap factor", 0.0001, 1.9999), usual::length(6, "Set-up clearance"),
    usual::coordinate(7, "Clearance height"), usual::choice(9, "Direction of rotation", -1, 1)};
constexpr std::array kProbing{usual::length(320, "Set-up clearance"),
                              usual::coordinate(260, "Clearance height"),
                              usual::choice(301, "Move to clearance height: 0 no, 1 yes", 0, 1)};
constexpr std::array kPositioning{usual::choice(345, "Positioning height: 0 last, 1 Q204", 0, 1)};

constexpr std::array<CycleDescriptor, 6> kDefinitions{
    {{.number = 100, .name = "GENERAL", .parameters = kGeneral},
     {.number = 105, .name = "DRILLING", .parameters = kDrilling},
     {.number = 110, .name = "POCKET MILLING", .parameters = kPocketMilling},
     {.number = 111, .name = "CONTOUR MILLING", .parameters = kContourMilling},
     {.number = 120, .name = "PROBING", .parameters = kProbing},
     {.number = 125, .name = "POSITIONING", .parameters = kPositioning}}};

}  // namespace

const CycleDescriptor* global_definition(int number) {
  const auto found = std::ranges::find(kDefinitions, number, &CycleDescriptor::number);
  return found == kDefinitions.end() ? nullptr : &*found;
}

const CycleDescriptor* global_definition_of(int parameter) {
  const auto has = [&](const CycleDescriptor& definition) {
    return definition.find(probing::q(parameter)) != nullptr;
  };
  const auto found = std::ranges::find_if(kDefinitions, has);
  return found == kDefinitions.end() ? nullptr : &*found;
}

}  // namespace fitgauge::interpreter
