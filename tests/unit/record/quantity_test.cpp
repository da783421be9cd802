#include <doctest/doctest.h>

#include "record/measurement_batch.hpp"
#include "record/record.hpp"
#include "unit/tables/iso286/tables_fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::api;

namespace {

/// The record of an object, or the first complaint: `POINTER CODE`.
std::string judged(std::string body) {
  const std::size_t size = body.size();
  body.append(64, '\0');
  MeasurementBatch batch;
  const auto decoded = decode_measurements(
      std::string_view(body).substr(0, size), "application/json",
      {.tables = iso286::standard_tables(), .received_at = {1'000'000'000}}, batch);
  if (!decoded) {
    const Error error = decoded.error();
    const Error& first = error.details.front();
    return first.where + ' ' + std::string(id(first.code));
  }
  std::string out;
  app::append_record(out, batch.rows.front());
  return out;
}

bool has(const std::string& record, std::string_view text) {
  return record.find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("what needs limits or a size is refused where there is none") {
  CHECK(judged(R"({"measured_mm":25,"quantity":"diameter","rule":"guard_band"})") ==
        "/rule field.conflict");
  CHECK(judged(R"({"measured_mm":25,"quantity":"diameter","uncertainty_um":1})") ==
        "/uncertainty_um field.conflict");
  CHECK(judged(R"({"measured_mm":25,"quantity":"diameter","feature":"hole"})") ==
        "/nominal_mm field.missing");
  CHECK(judged(R"({"measured_mm":25})") == "/nominal_mm field.missing");
}

TEST_CASE("a designation says its quantity, and what lies beyond its limits") {
  const auto record = [](const std::string& designation, const char* measured) {
    return judged(R"({"designation":")" + designation + R"(","measured_mm":)" + measured + "}");
  };
  struct Case {
    const char* designation;
    const char* measured;
    const char* quantity;
    const char* verdict;
  };
  for (const Case& one : std::vector<Case>{{"25 H7", "25.03", "diameter", "reject"},
                                           {"25 h6", "25.03", "diameter", "rework"},
                                           {"M10-6g", "8", "pitch_diameter", "reject"},
                                           {"25 ISO 2768-m", "26", "distance", "reject"},
                                           {"25 ISO 2768-m", "24", "distance", "reject"},
                                           {"R5 ISO 2768-m", "9", "radius", "reject"},
                                           {"R5 ISO 2768-m", "1", "radius", "rework"},
                                           {"C2 ISO 2768-m", "9", "chamfer", "reject"}}) {
    CAPTURE(one.designation);
    const std::string found = record(one.designation, one.measured);
    CHECK(has(found, std::string(R"("quantity":")") + one.quantity + '"'));
    CHECK(has(found, std::string(R"("verdict":")") + one.verdict + '"'));
  }
  // What is too large in an inside corner can still be cut.
  for (const char* one :
       {R"("R5 ISO 2768-m","measured_mm":9)", R"("C2 ISO 2768-m","measured_mm":9)"}) {
    const std::string corner =
        judged(std::string(R"({"inside_corner":true,"designation":)") + one + "}");
    CHECK(has(corner, R"("inside_corner":true,)"));
    CHECK(has(corner, R"("verdict":"rework")"));
  }
  CHECK(has(judged(R"({"inside_corner":true,"designation":"R5 ISO 2768-m","measured_mm":1})"),
            R"("verdict":"reject")"));
  CHECK(judged(R"({"inside_corner":true,"designation":"25 H7","measured_mm":25})") ==
        "/inside_corner field.conflict");
  CHECK(judged(R"({"inside_corner":true,"quantity":"position","measured_mm":25})") ==
        "/inside_corner field.conflict");
  CHECK(has(judged(R"({"designation":"25 ISO 2768-m","feature":"hole","measured_mm":24})"),
            R"("quantity":"diameter")"));
  CHECK(has(judged(R"({"designation":"8 N9","quantity":"width","measured_mm":7.99})"),
            R"("quantity":"width")"));
  CHECK(judged(R"({"designation":"25 H7","quantity":"radius","measured_mm":25})") ==
        "/quantity field.conflict");
  CHECK(judged(R"({"designation":"R5 ISO 2768-m","feature":"hole","measured_mm":5})") ==
        "/feature field.conflict");
}

TEST_CASE("limits of a drawing have a feature for sizes alone, and a sign for what has one") {
  const auto drawn = [](const std::string& fields) {
    return judged(R"({"upper_um":50,"lower_um":-50,)" + fields + "}");
  };
  const std::string position =
      drawn(R"("quantity":"position","nominal_mm":-50,"measured_mm":-50.08)");
  CHECK(has(position, R"("quantity":"position")"));
  CHECK(has(position, R"("verdict":"reject")"));
  CHECK(position.find("feature") == std::string::npos);
  CHECK(has(drawn(R"("quantity":"deviation","nominal_mm":0,"measured_mm":0)"),
            R"("verdict":"good")"));
  CHECK(has(drawn(R"("quantity":"distance","nominal_mm":30,"measured_mm":30.06)"),
            R"("verdict":"reject")"));
  CHECK(has(drawn(R"("quantity":"radius","nominal_mm":5,"measured_mm":4.9)"),
            R"("verdict":"rework")"));
  CHECK(drawn(R"("quantity":"position","feature":"hole","nominal_mm":1,"measured_mm":1)") ==
        "/feature field.conflict");
  CHECK(drawn(R"("quantity":"width","nominal_mm":1,"measured_mm":1)") == "/feature field.missing");
  CHECK(drawn(R"("quantity":"radius","nominal_mm":-5,"measured_mm":5)") ==
        "/nominal_mm length.out_of_range");
  CHECK(drawn(R"("quantity":"radius","nominal_mm":5,"measured_mm":-5)") ==
        "/measured_mm length.out_of_range");
  CHECK(drawn(R"("quantity":"position","nominal_mm":5,"measured_mm":-100000001)") ==
        "/measured_mm length.out_of_range");
  CHECK(drawn(R"("quantity":"angle","nominal_mm":5,"measured_mm":5)") == "/quantity field.invalid");
}

TEST_CASE("degrees of freedom count with what a correction to 20 degrees adds") {
  const std::string warm =
      judged(R"({"designation":"25 H7","measured_mm":25.01,"uncertainty_um":1,"rule":"guard_band",)"
             R"("degrees_of_freedom":2,"temperature_c":20,"part_material":"steel",)"
             R"("temperature_uncertainty_c":10})");
  CHECK(has(warm, R"("degrees_of_freedom":2,)"));
  CHECK_FALSE(has(warm, "4.526551"));
  CHECK(judged(R"({"designation":"25 H7","measured_mm":25,"degrees_of_freedom":2})") ==
        "/uncertainty_um field.missing");
}

TEST_CASE("an envelope is verified by a GO gauge alone") {
  const auto record = [](const std::string& designation, const char* measured,
                         const std::string& more) {
    return judged(R"({"designation":")" + designation + R"(","measured_mm":)" + measured + more +
                  "}");
  };
  const std::string open = record("25 H7 (E)", "25.01", "");
  CHECK(has(open, R"("designation":"25 H7",)"));
  CHECK(has(open, R"("envelope":"required","envelope_result":"not_verified")"));
  CHECK(has(record("25H7(E)", "25.01", R"(,"go_gauge":"passes")"),
            R"("envelope_result":"verified")"));
  CHECK(has(record("25H7(E)", "25.03", R"(,"go_gauge":"fails")"), R"("verdict":"reject")"));
  CHECK(has(record("25h6(E)", "24.99", R"(,"go_gauge":"fails")"), R"("verdict":"rework")"));
  CHECK(record("25H7", "25.01", R"(,"go_gauge":"fails")") == "/envelope field.missing");
  CHECK(record("25H7(E)", "25.01", R"(,"go_gauge":"sticks")") == "/go_gauge field.invalid");
  CHECK(record("R5 ISO 2768-m", "5", R"(,"envelope":"required")") == "/envelope field.conflict");
}
