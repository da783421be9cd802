#include "api/mtconnect/mtconnect_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/length.hpp"
#include "base/text.hpp"

namespace fitgauge::api::mtconnect {
namespace {

using gauging::Verdict;

/// Nothing is ever dropped, since the log is kept for ever: the largest number the schema takes.
constexpr std::string_view kBufferSize = "4294967294";

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += static_cast<unsigned char>(c) < ' ' || c == '\x7F' ? ' ' : c;
    }
  }
  return out;
}

/// A key is an NMTOKEN.
std::string key_of(std::string_view characteristic) {
  std::string key(characteristic.empty() ? std::string_view("size") : characteristic);
  std::replace_if(
      key.begin(), key.end(),
      [](char c) {
        return !is_ascii_alphanumeric(c) && c != '-' && c != '_' && c != '.' && c != ':';
      },
      '_');
  return key;
}

std::string_view status_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::Good: return "PASS";
    case Verdict::Rework: return "REWORK";
    case Verdict::Reject: return "FAIL";
    case Verdict::Indeterminate: break;
  }
  return "INDETERMINATE";
}

/// From 1 on, the same for the same data folder.
std::uint64_t instance_of(const Agent& agent) {
  std::uint32_t number = 0;
  const std::string_view digits = agent.origin.substr(0, 7);
  std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
  return std::uint64_t{number} + 1;
}

/// What the device is does not change.
std::string model_change(const Agent& agent) {
  return fmt::format(R"(deviceModelChangeTime="{}")", format_rfc3339(agent.began));
}

std::string head(const Agent& agent, std::string_view kind, std::string_view more) {
  return fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<MTConnect{0} xmlns="urn:mtconnect.org:MTConnect{0}:2.4">
<Header creationTime="{1}" sender="fitgauge" instanceId="{2}" version="2.4" {3}/>
)",
      kind, format_rfc3339(agent.now), instance_of(agent), more);
}

}  // namespace

void Streams::add_availability() {
  ++count_;
  events_ += fmt::format(
      R"(<Availability dataItemId="avail" sequence="1" timestamp="{0}">AVAILABLE</Availability>
)",
      format_rfc3339(agent_.began));
}

void Streams::add(const app::Measurement& measurement, std::uint64_t from) {
  const std::string at = format_rfc3339(measurement.received_at);
  if (part_sequence(measurement.row) >= from) {
    ++count_;
    const std::string part = escaped(measurement.texts.part_id.value_or(""));
    events_ += fmt::format(R"(<PartId dataItemId="part" sequence="{}" timestamp="{}">{}</PartId>
)",
                           part_sequence(measurement.row), at, part.empty() ? "UNAVAILABLE" : part);
  }
  ++count_;
  std::string cells = fmt::format(
      R"(<Cell key="MEASUREMENT_TYPE">DIAMETER</Cell><Cell key="MEASUREMENT_UNITS">MILLIMETER</Cell><Cell key="MEASUREMENT_VALUE">{}</Cell><Cell key="CHARACTERISTIC_STATUS">{}</Cell>)",
      format_mm(measurement.measured), status_of(measurement.result.verdict));
  if (measurement.standard_uncertainty) {
    cells += fmt::format(
        R"(<Cell key="UNCERTAINTY">{}</Cell><Cell key="UNCERTAINTY_TYPE">COMBINED</Cell>)",
        format_mm(*measurement.standard_uncertainty));
  }
  events_ += fmt::format(
      R"(<FeatureMeasurementTable dataItemId="feature" sequence="{}" timestamp="{}" count="1"><Entry key="{}">{}</Entry></FeatureMeasurementTable>
)",
      feature_sequence(measurement.row), at, key_of(measurement.texts.characteristic.value_or("")),
      cells);
}

void Streams::add_counts(const Counts& counts, Timestamp at) {
  const std::pair<std::string_view, std::int64_t> each[] = {
      {"ALL", counts.good + counts.rework + counts.reject + counts.indeterminate},
      {"GOOD", counts.good},
      {"BAD", counts.reject},
      {"x:REWORK", counts.rework},
      {"x:INDETERMINATE", counts.indeterminate}};
  std::size_t number = 0;
  for (const auto& [type, count] : each) {
    ++count_;
    events_ += fmt::format(
        R"(<PartCount dataItemId="count{}" subType="{}" sequence="{}" timestamp="{}">{}</PartCount>
)",
        ++number, type, std::max<std::uint64_t>(1, feature_sequence(agent_.newest)),
        format_rfc3339(at), count);
  }
}

void Streams::add_unavailable() {
  count_ += 2;
  events_ += fmt::format(
      R"(<PartId dataItemId="part" sequence="1" timestamp="{0}">UNAVAILABLE</PartId>
<FeatureMeasurementTable dataItemId="feature" sequence="1" timestamp="{0}" count="0">UNAVAILABLE</FeatureMeasurementTable>
)",
      format_rfc3339(agent_.began));
}

void Streams::add_assets() {
  count_ += 2;
  for (const std::string_view kind : {"Changed", "Removed"}) {
    events_ += fmt::format(
        R"(<Asset{0} dataItemId="asset_{1}" sequence="1" timestamp="{2}" assetType="">UNAVAILABLE</Asset{0}>
)",
        kind, ascii_lower(kind), format_rfc3339(agent_.began));
  }
}

std::string Streams::document(std::uint64_t next) const {
  const std::string more =
      fmt::format(R"({} bufferSize="{}" firstSequence="1" lastSequence="{}" nextSequence="{}")",
                  model_change(agent_), kBufferSize, feature_sequence(agent_.newest), next);
  return head(agent_, "Streams", more) +
         fmt::format(R"(<Streams><DeviceStream name="Gauge" uuid="fitgauge-{}">
<ComponentStream component="Device" componentId="gauge" name="Gauge">{}</ComponentStream>
</DeviceStream></Streams>
</MTConnectStreams>
)",
                     agent_.origin,
                     events_.empty() ? std::string() : "<Events>\n" + events_ + "</Events>");
}

std::string devices_document(const Agent& agent) {
  return head(agent, "Devices",
              fmt::format(R"({} bufferSize="{}" assetBufferSize="1" assetCount="0")",
                          model_change(agent), kBufferSize)) +
         fmt::format(R"(<Devices><Device id="gauge" name="Gauge" uuid="fitgauge-{}">
<Description manufacturer="fitgauge">Measured sizes with their verdicts</Description>
<DataItems>
<DataItem category="EVENT" id="avail" type="AVAILABILITY"/>
<DataItem category="EVENT" id="asset_changed" type="ASSET_CHANGED" discrete="true"/>
<DataItem category="EVENT" id="asset_removed" type="ASSET_REMOVED"/>
<DataItem category="EVENT" id="part" type="PART_ID"/>
<DataItem category="EVENT" id="count1" type="PART_COUNT" subType="ALL"/>
<DataItem category="EVENT" id="count2" type="PART_COUNT" subType="GOOD"/>
<DataItem category="EVENT" id="count3" type="PART_COUNT" subType="BAD"/>
<DataItem category="EVENT" id="count4" type="PART_COUNT" subType="x:REWORK"/>
<DataItem category="EVENT" id="count5" type="PART_COUNT" subType="x:INDETERMINATE"/>
<DataItem category="EVENT" id="feature" type="FEATURE_MEASUREMENT" representation="TABLE">
<Definition><CellDefinitions>
<CellDefinition key="MEASUREMENT_TYPE" type="MEASUREMENT_TYPE"/>
<CellDefinition key="MEASUREMENT_UNITS" type="MEASUREMENT_UNITS"/>
<CellDefinition key="MEASUREMENT_VALUE" type="MEASUREMENT_VALUE"/>
<CellDefinition key="CHARACTERISTIC_STATUS" type="CHARACTERISTIC_STATUS"/>
<CellDefinition key="UNCERTAINTY" type="UNCERTAINTY"/>
<CellDefinition key="UNCERTAINTY_TYPE" type="UNCERTAINTY_TYPE"/>
</CellDefinitions></Definition>
</DataItem>
</DataItems>
</Device></Devices>
</MTConnectDevices>
)",
                     agent.origin);
}

std::string error_document(const Agent& agent, std::string_view code, std::string_view message) {
  return head(agent, "Error", fmt::format(R"(bufferSize="{}")", kBufferSize)) +
         fmt::format(R"(<Errors><Error errorCode="{}">{}</Error></Errors>
</MTConnectError>
)",
                     code, escaped(message));
}

}  // namespace fitgauge::api::mtconnect
