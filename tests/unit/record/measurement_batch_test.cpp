#include "record/measurement_batch.hpp"

#include <doctest/doctest.h>

#include "base/csv.hpp"
#include "record/record.hpp"
#include "unit/tables/iso286/tables_fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::api;

namespace {

BatchContext now() { return {.tables = iso286::standard_tables(), .received_at = {1'000'000'000}}; }

/// The body with the padding the HTTP engine gives it. Batches are views of it, so it is kept.
Result<MeasurementBatch> decode(std::string body, std::string_view type = "application/json",
                                const BatchContext& context = now()) {
  static std::vector<std::unique_ptr<std::string>> kept;
  const std::size_t size = body.size();
  body.append(64, '\0');
  kept.push_back(std::make_unique<std::string>(std::move(body)));
  MeasurementBatch batch;
  const auto decoded =
      decode_measurements(std::string_view(*kept.back()).substr(0, size), type, context, batch);
  if (!decoded) return decoded.error();
  return batch;
}

/// The one row of a batch. Its texts are views of the batch, so that is kept too.
app::Measurement one(std::string body, std::string_view type = "application/json",
                     const BatchContext& context = now()) {
  static std::vector<MeasurementBatch> kept;
  auto batch = decode(std::move(body), type, context);
  REQUIRE(batch.has_value());
  REQUIRE(batch->rows.size() == 1);
  kept.push_back(*std::move(batch));
  return kept.back().rows.front();
}

/// "pointer code" of every entry, with "@line" where there is one.
std::vector<std::string> complaints(std::string body, std::string_view type = "application/json",
                                    const BatchContext& context = now()) {
  const auto batch = decode(std::move(body), type, context);
  REQUIRE(batch.error().code == ErrorCode::RequestInvalid);
  std::vector<std::string> found;
  for (const Error& entry : batch.error().details) {
    std::string text = entry.where + ' ' + std::string(id(entry.code));
    if (!entry.details.empty()) text += '@' + entry.details.front().where;
    found.push_back(std::move(text));
  }
  return found;
}

using Complaints = std::vector<std::string>;

}  // namespace

TEST_CASE("every bad field of every row is reported with its pointer") {
  CHECK(complaints(R"([{"designation":"25 H7","measured_mm":25},
                       {"designation":"25 H19","measured_mm":null,"x":1},
                       7,
                       {"nominal_mm":10,"tolerance_class":"t6","measured_mm":""}])") ==
        Complaints{"/1/measured_mm field.type", "/1/x field.unknown",
                   "/1/designation class.unknown", "/2 field.type",
                   "/3/measured_mm length.malformed",
                   "/3/tolerance_class class.undefined_for_size"});
}

TEST_CASE("unreadable JSON is no request with bad fields") {
  CHECK(decode(R"({"x":25,"x":25})").error().code == ErrorCode::JsonDuplicateKey);
  CHECK(decode(R"([{"designation":"25 H7","measured_mm":25}] [])").error().code ==
        ErrorCode::JsonMalformed);
  CHECK(decode("\xEF\xBB\xBF{}").error().code == ErrorCode::TextEncoding);
  CHECK(decode("{\"part_id\":\"\xFF\"}").error().code == ErrorCode::TextEncoding);
  CHECK(decode("[]").error().code == ErrorCode::RequestInvalid);
}

TEST_CASE("escaped texts and keys mean the same") {
  const auto m =
      one(R"({"designation":"25\u0020H7","measured_mm":25.013,"comment":"a\"b\\\u00b5"})");
  CHECK(m.comment == "a\"b\\\xC2\xB5");
  CHECK(one(R"({"\u0064esignation":"25 H7","measured_mm":25.013})").measured ==
        Length::nanometres(25'013'000));
}

TEST_CASE("limits are given once, in one of three ways") {
  const auto drawing = one(
      R"({"nominal_mm":25,"feature":"shaft","upper_um":10,"lower_um":-3.5,"measured_mm":25.0101})");
  CHECK(drawing.basis == app::LimitsBasis::Explicit);
  CHECK(drawing.result.verdict == gauging::Verdict::Rework);
  CHECK_FALSE(drawing.class_name.has_value());
  CHECK(complaints(R"({"designation":"25 H7","nominal_mm":25,"measured_mm":25})") ==
        Complaints{"/nominal_mm field.conflict"});
  for (const std::string place : {"upper_um", "lower_um"}) {
    CHECK(complaints(R"({"designation":"25 H7",")" + place + R"(":1,"measured_mm":25})") ==
          Complaints{"/" + place + " field.conflict"});
  }
  CHECK(
      complaints(R"({"nominal_mm":25,"tolerance_class":"H7","feature":"hole","measured_mm":25})") ==
      Complaints{"/tolerance_class field.conflict"});
  CHECK(complaints(R"({"nominal_mm":25,"measured_mm":25})") ==
        Complaints{"/tolerance_class field.missing"});
  CHECK(complaints(R"({"nominal_mm":25,"feature":"hole","measured_mm":25})") ==
        Complaints{"/upper_um field.missing"});
  CHECK(complaints(R"({"nominal_mm":25,"upper_um":1,"measured_mm":25})") ==
        Complaints{"/feature field.missing"});
  CHECK(complaints(
            R"({"nominal_mm":25,"feature":"hole","upper_um":1,"lower_um":2,"measured_mm":25})") ==
        Complaints{"/upper_um limits.invalid"});
  for (const auto& [deviations, place] :
       {std::pair(R"("upper_um":-25000)", "/upper_um"),
        std::pair(R"("lower_um":-25000)", "/lower_um"),
        std::pair(R"("upper_um":0,"lower_um":-26000)", "/lower_um")}) {
    CHECK(complaints(fmt::format(R"({{"nominal_mm":25,"feature":"hole",{},"measured_mm":25}})",
                                 deviations)) ==
          Complaints{fmt::format("{} limits.invalid", place)});
  }
}

TEST_CASE("limits are checked beside other bad fields, and not by a quantity that is none") {
  CHECK(complaints(
            R"({"measured_mm":null,"nominal_mm":25,"feature":"hole","upper_um":1,"lower_um":2})") ==
        Complaints{"/measured_mm field.type", "/upper_um limits.invalid"});
  CHECK(complaints(R"({"measured_mm":25,"nominal_mm":25,"feature":"hole","upper_um":"x"})") ==
        Complaints{"/upper_um length.malformed"});
  CHECK(
      complaints(
          R"({"measured_mm":-1,"nominal_mm":0,"quantity":"positon","upper_um":5,"lower_um":-5})") ==
      Complaints{"/quantity field.invalid"});
}

TEST_CASE("what a spreadsheet would run as a formula is guarded in CSV, and read back as it was") {
  const std::pair<const char*, const char*> rows[] = {
      {"=HYPERLINK(A1)", "'=HYPERLINK(A1)"},
      {"+1", "'+1"},
      {"-1", "'-1"},
      {"@x", "'@x"},
      {"'=1", "''=1"},
      {"'a", "'a"},
      {"a=1", "a=1"},
      {"", ""},
      {"\tx", "'\tx"},
  };
  for (const auto& [text, cell] : rows) {
    std::string out;
    sheet::append_csv_text(out, text);
    CHECK(out == cell);
    CHECK(sheet::without_formula_guard(out) == text);
  }
  const auto batch =
      decode("designation,measured_mm,comment\n25 H7,25.01,'=1\n", "text/csv").value();
  CHECK(batch.rows.front().comment == "=1");
}

TEST_CASE("CSV names column, row and line of what is wrong") {
  CHECK(one("nominal_mm,tolerance_class,measured_mm\n\"25,5\",H7,25.5\n", "text/csv").measured ==
        Length::nanometres(25'500'000));
  CHECK(complaints("designation,measured_mm,x\n25 H7,25,1\n25 H7,,2\n", "text/csv") ==
        Complaints{"/x field.unknown@1", "/1/measured_mm field.missing@3"});
  CHECK(decode("designation,designation\n1,2\n", "text/csv").error().code ==
        ErrorCode::CsvMalformed);
}

TEST_CASE("NDJSON names row and line") {
  CHECK(complaints("{\"designation\":\"25 H7\",\"measured_mm\":25}\n\n"
                   "{\"designation\":\"25 H7\",\"measured_mm\":true}\r\n",
                   "application/x-ndjson") == Complaints{"/1/measured_mm field.type@3"});
  const auto broken =
      decode("{\"designation\":\"25 H7\",\"measured_mm\":25}\n{\n", "application/x-ndjson");
  CHECK(broken.error().code == ErrorCode::JsonMalformed);
  CHECK(broken.error().where == "line 2");
  CHECK(broken.error().message.starts_with("line 2, column "));
  const auto repeated =
      decode("{\"designation\":\"25 H7\",\"measured_mm\":25}\n{\"a\":1,\"a\":2}\n",
             "application/x-ndjson");
  CHECK(repeated.error().message == "line 2: the key \"a\" occurs twice");
}

namespace {

/// `count` rows in each format; row `odd` has a text with an escape and a key that only the exact
/// reader of JSON takes.
std::string list_of(int count, std::string_view type, int odd) {
  const bool csv = type == "text/csv";
  const bool json = type == "application/json";
  std::string body = csv ? "designation,measured_mm,part_id\n" : json ? "[" : "";
  for (int i = 0; i < count; ++i) {
    const std::string part = i == odd ? (csv ? "\"odd\"" : "o\\u0064d") : std::to_string(i);
    if (csv) {
      body += "25 H7,25.01," + part + '\n';
    } else {
      const std::string key = i == odd ? "p\\u0061rt_id" : "part_id";
      body += R"({"designation":"25 H7","measured_mm":25.01,")" + key + "\":\"" + part + "\"}" +
              (json ? "," : "\n");
    }
  }
  if (json) body.back() = ']';
  return body;
}

struct Pieces {
  std::vector<std::vector<app::Measurement>> taken;
  MeasurementBatch rest;
  Result<void> decoded;
  bool in_vain = false;  ///< the pieces were not to be used: all came with the second reading

  std::vector<std::string> parts() const {
    std::vector<std::string> found;
    for (const auto& piece : taken) {
      for (const auto& m : piece) found.emplace_back(m.part_id.value());
    }
    for (const auto& m : rest.rows) found.emplace_back(m.part_id.value());
    return found;
  }
};

/// @param body is a view of it afterwards, with padding.
Pieces in_pieces(std::string& body, std::string_view type) {
  Pieces pieces;
  const std::size_t size = body.size();
  body.append(64, '\0');
  const std::string_view text = std::string_view(body).substr(0, size);
  BatchContext context = now();
  context.take = [&](std::vector<app::Measurement> rows) {
    pieces.taken.push_back(std::move(rows));
  };
  pieces.decoded = decode_measurements(text, type, context, pieces.rest);
  pieces.in_vain = pieces.rest.wants_whole;
  if (pieces.in_vain) {
    CHECK(pieces.decoded.has_error());
    pieces.taken.clear();
    pieces.rest = {};
    context.take = nullptr;
    pieces.decoded = decode_measurements(text, type, context, pieces.rest);
  }
  return pieces;
}

}  // namespace

TEST_CASE("a stop ends the reading of a long list after the piece that is taken, in every format") {
  for (const std::string_view type : {"application/json", "application/x-ndjson", "text/csv"}) {
    for (const bool is_exact : {false, true}) {
      CAPTURE(type);
      CAPTURE(is_exact);
      std::string body = list_of(1000, type, -1);
      const std::size_t size = body.size();
      body.append(64, '\0');
      std::stop_source stop;
      BatchContext context = now();
      context.is_exact = is_exact;
      context.stop = stop.get_token();
      int taken = 0;
      context.take = [&](const std::vector<app::Measurement>&) {
        if (++taken == 2) stop.request_stop();
      };
      MeasurementBatch batch;
      const auto text = std::string_view(body).substr(0, size);
      CHECK(decode_measurements(text, type, context, batch).error().code ==
            ErrorCode::ShuttingDown);
      CHECK(taken == 2);
      CHECK(batch.rows.empty());
    }
  }
}

TEST_CASE("a long list is taken away in pieces while it is read, in every format") {
  constexpr int kCount = 1000;
  for (const std::string_view type : {"application/json", "application/x-ndjson", "text/csv"}) {
    for (const int odd : {-1, 0, 255, 256, 600, 999}) {
      CAPTURE(type);
      CAPTURE(odd);
      std::string body = list_of(kCount, type, odd);
      const Pieces pieces = in_pieces(body, type);
      const bool is_late = odd >= static_cast<int>(kRowsAtATime);
      CHECK(pieces.in_vain == (is_late && type == "application/json"));
      REQUIRE(pieces.decoded.has_value());
      if (!pieces.in_vain) CHECK(pieces.taken.size() == kCount / kRowsAtATime);
      const auto parts = pieces.parts();
      REQUIRE(parts.size() == kCount);
      for (int i = 0; i < kCount; ++i) {
        const auto& part = parts[static_cast<std::size_t>(i)];
        CHECK(part == (i == odd ? "odd" : std::to_string(i)));
      }
    }
  }
}

TEST_CASE("escaped texts alone do not need the exact reader") {
  std::string body = "[";
  for (int i = 0; i < 1000; ++i) {
    body += R"({"designation":"25 H7","measured_mm":25.01,"part_id":"\u00b5)" + std::to_string(i) +
            "\"},";
  }
  body.back() = ']';
  const Pieces pieces = in_pieces(body, "application/json");
  CHECK_FALSE(pieces.in_vain);
  const auto parts = pieces.parts();
  REQUIRE(parts.size() == 1000);
  CHECK(parts.front() ==
        "\xC2\xB5"
        "0");
  CHECK(parts.back() ==
        "\xC2\xB5"
        "999");
}

TEST_CASE("a list of what is no measurement is refused at the 100,001st, not kept") {
  std::string body = "[";
  for (int i = 0; i < 600'000; ++i) body += "1,";
  body.back() = ']';
  CHECK(decode(body).error().message.find("at most 100000 rows") != std::string::npos);
}

TEST_CASE("a wrong row is named when rows before it were taken already, and so are all others") {
  std::string body = list_of(1000, "application/json", -1);
  body.pop_back();
  body += R"(,{"designation":"25 H7"},{"designation":"25 H7","measured_mm":25,"x":1})";
  for (int i = 0; i < 300; ++i) body += R"(,{"designation":"25 H7","measured_mm":25})";
  body += ']';
  const Pieces pieces = in_pieces(body, "application/json");
  CHECK(pieces.in_vain);
  REQUIRE(pieces.decoded.has_error());
  REQUIRE(pieces.decoded.error().details.size() == 2);
  CHECK(pieces.decoded.error().details[0].where == "/1000/measured_mm");
  CHECK(pieces.decoded.error().details[1].where == "/1001/x");
}

TEST_CASE("a gauge in use is overdue after its last nanosecond, and says what counts then") {
  const Timestamp due = parse_rfc3339("2026-03-31T23:59:59.999999999Z").value();
  const GaugeBook book = {{"G-07",
                           {{{.budget = "ring",
                              .standard_uncertainty = Length::nanometres(501),
                              .calibration_due = "2026-03-31",
                              .due = due,
                              .certificate = "K-1"}}}},
                          {"G-08", {{{.calibration_due = "2026-03-31", .due = due}}}},
                          {"G-10", {{{.certificate = "K-1", .is_blocked = true}}}}};
  BatchContext context{
      .tables = iso286::standard_tables(), .received_at = {due.nanoseconds + 1}, .gauges = &book};
  const auto judged = [&](const std::string& fields, std::string_view type) {
    return one(R"({"designation":"25 H7","measured_mm":25.0005)" + fields + "}", type, context);
  };
  for (const std::string_view type : {"application/json", "application/x-ndjson"}) {
    CAPTURE(type);
    const auto late = judged(R"(,"gauge":"G-07","rule":"guard_band")", type);
    CHECK(late.uncertainty_budget == "ring");
    CHECK(late.calibration_due == "2026-03-31");
    CHECK_FALSE(late.calibration_certificate);
    const auto in_time = judged(
        R"(,"gauge":"G-07","rule":"conformance","measured_at":"2026-03-31T23:59:59.999999999Z")",
        type);
    CHECK(in_time.calibration_certificate == "K-1");
    CHECK_FALSE(in_time.calibration_due);
    const auto blocked = judged(R"(,"gauge":"G-10")", type);
    CHECK(blocked.gauge_blocked);
    CHECK_FALSE(blocked.calibration_certificate);
  }
  for (const char* gauge : {"G-08", "G-09"}) {
    CHECK(complaints(std::string(R"({"designation":"25 H7","measured_mm":25,"gauge":")") + gauge +
                         R"(","rule":"guard_band"})",
                     "application/json", context) == Complaints{"/uncertainty_um field.missing"});
  }
}

TEST_CASE("an offset is kept in nanometres, and is at most a metre either way") {
  const auto m = one(R"({"designation":"25 H7","measured_mm":25.01,"offset_um":-2.125})");
  CHECK(m.offset == -2'125);
  CHECK(complaints(R"({"designation":"25 H7","measured_mm":25.01,"offset_um":1000000.001})") ==
        Complaints{"/offset_um number.out_of_range"});
  CHECK(complaints(R"({"designation":"25 H7","measured_mm":25.01,"offset_um":0.0001})") ==
        Complaints{"/offset_um field.invalid"});
}
