#include "base/text.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/log/measuring_log.hpp"
#include "nc/probing/measured_value.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing::cycle_450 {

using namespace parameter;
using machine::Kinematics;

constexpr int kName = 409;
constexpr std::size_t kMostRecords = 16;
constexpr std::size_t kLongestName = 16;

constexpr HtmlLog kLog{"TCHPR450.html", "Log of cycle 450",
                       "Log of touch-probe cycle 450 SAVE KINEMATICS", "", true};

constexpr std::array kParameters{choice(410, "Mode: 0 save, 1 restore, 2 status, 3 delete", 0, 3),
                                 CycleParameter{.id = q(kName),
                                                .meaning = "Number or name of the record",
                                                .kind = ValueKind::NumberOrText,
                                                .range = {0, 99999},
                                                .required = false}};

/// @errors 1017 no name, 1011 a name that is empty, longer than 16 characters or not printable, or
/// a broken number.
CycleResult<std::string> record_name(const Arguments& arguments) {
  if (const std::string* text = arguments.text(q(kName))) {
    const std::string_view name = trim(*text);
    const bool printable = std::ranges::none_of(name, [](unsigned char c) { return c < ' '; });
    if (!name.empty() && name.size() <= kLongestName && printable) return std::string(name);
    return nc_error(1011, fmt::format("QS409 has 1 to {} characters", kLongestName));
  }
  if (!arguments.has_number(q(kName))) return nc_error(1017, "Q409 or QS409 names the record");
  const double number = arguments.number(kName);
  if (number != std::nearbyint(number)) return nc_error(1011, "Q409 must be a whole number");
  return fmt::format("{:.0f}", number);
}

std::string mm(double value) { return log_text(to_length(value), false); }

/// Every transformation of a kinematic model as a table.
std::string table_of(const Kinematics& model) {
  std::string html =
      "<table>\n<thead><tr><th scope=\"col\">Axis</th><th scope=\"col\">X</th>"
      "<th scope=\"col\">Y</th><th scope=\"col\">Z</th><th scope=\"col\">Direction</th></tr>"
      "</thead>\n<tbody>\n";
  for (const machine::RotaryAxis& axis : model.axes()) {
    html += fmt::format(
        "<tr><th scope=\"row\">{} in the {}</th><td>{}</td><td>{}</td><td>{}</td>"
        "<td>{} {} {}</td></tr>\n",
        name(axis.axis), axis.mount == machine::AxisMount::Table ? "table" : "head",
        mm(axis.centre.x), mm(axis.centre.y), mm(axis.centre.z), fixed(axis.direction.x, 7),
        fixed(axis.direction.y, 7), fixed(axis.direction.z, 7));
  }
  const Vec3& offset = model.offset();
  return html + fmt::format(
                    "<tr><th scope=\"row\">Offset of the tool</th><td>{}</td><td>{}</td>"
                    "<td>{}</td><td></td></tr>\n</tbody>\n</table>\n",
                    mm(offset.x), mm(offset.y), mm(offset.z));
}

CycleResult<std::string> save(const CycleContext& context, KinematicsRecords& records,
                              const std::string& record) {
  if (!records.contains(record) && records.size() >= kMostRecords) {
    return nc_error(1097, fmt::format("{} records are stored: delete one first", kMostRecords));
  }
  const Kinematics& active = context.machine.state().kinematics;
  records.insert_or_assign(record, active);
  TRY(context.host.keep_kinematics(records));
  return fmt::format("<p>Saved as {}</p>\n{}", escape_html(record), table_of(active));
}

CycleResult<std::string> restore(const CycleContext& context, const KinematicsRecords& records,
                                 const std::string& record) {
  const auto saved = records.find(record);
  if (saved == records.end()) return nc_error(1096, fmt::format("record not found: {}", record));
  const std::string before = table_of(context.machine.state().kinematics);
  if (const auto set = context.machine.set_kinematics(saved->second); !set) {
    return nc_error(1096, set.error().text);  // of another machine
  }
  return fmt::format("<p>Restored from {}. Before:</p>\n{}<p>Now:</p>\n{}", escape_html(record),
                     before, table_of(saved->second));
}

std::string status(const KinematicsRecords& records) {
  std::string html = fmt::format("<p>{} of {} records:</p>\n", records.size(), kMostRecords);
  for (const auto& [record, model] : records) {
    html += fmt::format("<p>{}</p>\n", escape_html(record));
  }
  return html;
}

CycleResult<std::string> remove(const CycleContext& context, KinematicsRecords& records,
                                const std::string& record) {
  if (records.erase(record) == 0) {
    return nc_error(1011, fmt::format("record not found: {}", record));
  }
  TRY(context.host.keep_kinematics(records));
  return fmt::format("<p>Deleted {}</p>\n", escape_html(record));
}

/// Runs the action of Q410. @return the text of the log.
CycleResult<std::string> handle(const CycleContext& context) {
  constexpr int kSave = 0;
  constexpr int kRestore = 1;
  constexpr int kStatus = 2;
  const int mode = context.arguments.whole(410);
  auto records = TRY(context.host.kinematics_records());
  if (mode == kStatus) return status(records);
  const auto record = TRY(record_name(context.arguments));
  if (mode == kSave) return save(context, records, record);
  if (mode == kRestore) return restore(context, records, record);
  return remove(context, records, record);
}

CycleResult<void> manage_kinematics(const CycleContext& context) {
  const auto text = TRY(handle(context));
  return add_section(context.host, kLog,
                     fmt::format("<section>\n<h2>Kinematics on {}</h2>\n{}</section>\n",
                                 date_and_time(context.host), text));
}

constinit const TouchProbeCycle kCycle450 = cycle(
    450, "SAVE KINEMATICS", CycleKind::Kinematics, kParameters, {}, {1011, 1017, 1096, 1097},
    manage_kinematics,
    "All modes, with a number (Q409) or a name of up to 16 characters (QS409). Up to 16 "
    "records in TNC:\\table\\DATA450.KD, which, as all that a run writes, stays in the run "
    "unless it is put on the control's disk. The log TCHPR450.html has every axis, before and "
    "after restoring; the status is its list of records.");

}  // namespace fitgauge::probing::cycle_450
