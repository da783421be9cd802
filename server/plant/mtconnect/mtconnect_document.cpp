#include "plant/mtconnect/mtconnect_document.hpp"

namespace fitgauge::mtconnect {
namespace {

/// The largest number of the schema: the log is kept for ever, so the buffer drops nothing.
constexpr std::string_view kBufferSize = "4294967294";

/// Returns the key of a characteristic, an NMTOKEN of XML.
std::string key_of(std::string_view characteristic) {
  std::string key(characteristic.empty() ? std::string_view("size") : characteristic);
  std::ranges::replace_if(
      key,
      [](char c) {
        return !is_ascii_alphanumeric(c) && c != '-' && c != '_' && c != '.' && c != ':';
      },
      '_');
  return key;
}

std::string_view status_of(gauging::Verdict verdict) {
  return word_of(verdict, {"PASS", "REWORK", "FAIL", "INDETERMINATE", "UNDEFINED"});
}

/// Returns a number from 1, equal for equal histories of a data folder.
std::uint64_t instance_of(const Agent& agent) {
  std::uint32_t number = 0;
  const std::string_view digits = agent.history.substr(0, 7);
  std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
  return std::uint64_t{number} + 1;
}

/// Returns the attribute of the time when the description of the device changed: never.
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

Counts counts_of(const std::vector<app::MeasurementGroup>& groups) {
  Counts counts{};
  for (const app::MeasurementGroup& group : groups) {
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += group.verdicts[i];
  }
  return counts;
}

std::array<std::pair<std::string_view, std::int64_t>, 5> counts_by_item(const Counts& counts) {
  const auto [good, rework, reject, indeterminate, unjudged] = counts;
  return {{{"count1", good + rework + reject + indeterminate},
           {"count2", good},
           {"count3", reject},
           {"count4", rework},
           {"count5", indeterminate}}};
}

std::string entry_of(const app::Measurement& measurement) {
  return key_of(measurement.characteristic.value_or(""));
}

std::vector<std::pair<std::string_view, std::string>> cells_of(
    const app::Measurement& measurement) {
  std::vector<std::pair<std::string_view, std::string>> cells = {
      {"MEASUREMENT_TYPE",
       ascii_upper(word(measurement.quantity.value_or(gauging::Quantity::Diameter)))},
      {"MEASUREMENT_UNITS", "MILLIMETER"},
      {"MEASUREMENT_VALUE", format_mm(measurement.measured)},
      {"CHARACTERISTIC_STATUS", std::string(status_of(measurement.result.verdict))}};
  if (measurement.standard_uncertainty) {
    cells.emplace_back("UNCERTAINTY", format_mm(*measurement.standard_uncertainty));
    cells.emplace_back("UNCERTAINTY_TYPE", "COMBINED");
  }
  return cells;
}

void Streams::append(std::string_view element, std::string_view id, std::uint64_t sequence,
                     Timestamp at, std::string_view attributes, std::string_view text) {
  const auto* const item = std::ranges::find(kDataItems, id, &DataItem::id);
  if (!selection_.test(static_cast<std::size_t>(item - kDataItems.begin()))) return;
  ++count_;
  const std::string sub_type =
      item->sub_type.empty() ? "" : fmt::format(R"( subType="{}")", item->sub_type);
  events_ += fmt::format(R"(<{0} dataItemId="{1}"{2} sequence="{3}" timestamp="{4}"{5}>{6}</{0}>)",
                         element, id, sub_type, sequence, format_rfc3339(at), attributes, text);
  events_ += '\n';
}

void Streams::add(const app::Measurement& measurement, std::uint64_t sequence) {
  const Timestamp at = measurement.received_at;
  if (sequence == part_sequence(measurement.row)) {
    const std::string part = xml_text(measurement.part_id.value_or(""));
    return append("PartId", "part", sequence, at, "",
                  part.empty() ? kUnavailable : std::string_view(part));
  }
  std::string cells;
  for (const auto& [key, text] : cells_of(measurement)) {
    cells += fmt::format(R"(<Cell key="{}">{}</Cell>)", key, text);
  }
  append("FeatureMeasurementTable", "feature", sequence, at, R"( count="1")",
         fmt::format(R"(<Entry key="{}">{}</Entry>)", entry_of(measurement), cells));
}

void Streams::add_counts(const Counts& counts, std::int64_t newest, Timestamp at) {
  for (const auto& [id, count] : counts_by_item(counts)) {
    append("PartCount", id, feature_sequence(newest), at, "", std::to_string(count));
  }
}

void Streams::add_assets(std::int64_t newest, Timestamp at) {
  append("AssetChanged", "asset_changed", feature_sequence(newest), at,
         fmt::format(R"( assetType="{}")", newest > 0 ? "QIFDocumentWrapper" : ""),
         newest > 0 ? asset_id(agent_) : std::string(kUnavailable));
  append("AssetRemoved", "asset_removed", 1, agent_.began, R"( assetType="")", kUnavailable);
}

std::string asset_id(const Agent& agent) {
  return fmt::format("fitgauge-{}-results", agent.origin);
}

std::string assets_document(const Agent& agent, std::string_view qif, Timestamp at) {
  std::string asset;
  if (!qif.empty()) {
    asset = fmt::format(
        R"(<QIFDocumentWrapper assetId="{}" deviceUuid="fitgauge-{}" timestamp="{}" qifDocumentType="RESULTS"><QIFDocument>
{}</QIFDocument></QIFDocumentWrapper>)",
        asset_id(agent), agent.origin, format_rfc3339(at), qif);
  }
  return head(agent, "Assets",
              fmt::format(R"({} assetBufferSize="1" assetCount="{}")", model_change(agent),
                          qif.empty() ? 0 : 1)) +
         fmt::format("<Assets>{}</Assets>\n</MTConnectAssets>\n", asset);
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
  std::string items;
  for (const DataItem& item : kDataItems) {
    const bool is_table = item.id == "feature";
    items +=
        fmt::format(R"(<DataItem category="EVENT" id="{}" type="{}"{}{}{}>
)",
                    item.id, item.type,
                    item.sub_type.empty() ? "" : fmt::format(R"( subType="{}")", item.sub_type),
                    item.is_discrete ? R"( discrete="true")" : "",
                    is_table ? R"( representation="TABLE")" : "/");
  }
  std::string cells;
  for (const char* const key : {"MEASUREMENT_TYPE", "MEASUREMENT_UNITS", "MEASUREMENT_VALUE",
                                "CHARACTERISTIC_STATUS", "UNCERTAINTY", "UNCERTAINTY_TYPE"}) {
    cells += fmt::format("<CellDefinition key=\"{0}\" type=\"{0}\"/>\n", key);
  }
  return head(agent, "Devices",
              fmt::format(R"({} bufferSize="{}" assetBufferSize="1" assetCount="{}")",
                          model_change(agent), kBufferSize, agent.has_asset ? 1 : 0)) +
         fmt::format(R"(<Devices><Device id="gauge" name="Gauge" uuid="fitgauge-{}">
<Description manufacturer="fitgauge">Measured sizes with their verdicts</Description>
<DataItems>
{}<Definition><CellDefinitions>
{}</CellDefinitions></Definition>
</DataItem>
</DataItems>
</Device></Devices>
</MTConnectDevices>
)",
                     agent.origin, items, cells);
}

std::string error_document(const Agent& agent, std::string_view code, std::string_view message) {
  return head(agent, "Error", fmt::format(R"(bufferSize="{}")", kBufferSize)) +
         fmt::format(R"(<Errors><Error errorCode="{}">{}</Error></Errors>
</MTConnectError>
)",
                     code, xml_text(message));
}

}  // namespace fitgauge::mtconnect
