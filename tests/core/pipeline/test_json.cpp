// SPDX-License-Identifier: MIT
#include <QTest>
#include <limits>

#include "relucent/base/message.h"
#include "relucent/pipeline/json.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::calibration;
using namespace relucent::compensation;
using namespace relucent::pipeline;

/// The documents that scripts rely on: their keys stay.
class TestJson : public QObject {
  Q_OBJECT

 private slots:
  void calibrateDocument() {
    CalibrateResult result{805,  1551,       {1.0, 2.0, 3.0},      30000000, 2000000, 0.01, 0.02,
                           0.03, 4000000000, {Message::plain("a")}};
    QCOMPARE(
        toJson(result).dump(),
        std::string(R"({"patterns":805,"exposures":1551,"seconds":{"linearization":1.0,"acquisition":2.0,)"
                    R"("inverse":3.0},"connections":30000000,"leaves":2000000,"unresolved_energy":0.01,)"
                    R"("flagged_share":0.02,"verification_error":0.03,"peak_memory_bytes":4000000000,)"
                    R"("findings":["a"]})"));
  }

  void proveDocument() {
    ProveResult result;
    result.method = Method::refined;
    result.before = {{20.0, 8.0}, {19.5, 8.5}, 0.25, 1.5};
    result.after = {{30.0, 2.0}, {29.5, 2.5}, 0.125, 3.0};
    result.reachable = 0.75;
    result.moved = {0.5, -1.25, 0.125, true};
    result.exposures = 8;
    result.seconds = 2.0;
    result.files = {"out/comparison.png"};
    QCOMPARE(
        toJson(result).dump(),
        std::string(
            R"({"method":"refined","before":{"psnr_predicted":20.0,"psnr_measured":19.5,)"
            R"("delta_e_predicted":8.0,"delta_e_measured":8.5,"surprise":0.25,"worst_patch":1.5,"worst_place":[0.0,0.0]},"after":)"
            R"({"psnr_predicted":30.0,"psnr_measured":29.5,"delta_e_predicted":2.0,)"
            R"("delta_e_measured":2.5,"surprise":0.125,"worst_patch":3.0,"worst_place":[0.0,0.0]},"reachable":0.75,)"
            R"("moved":{"x":0.5,"y":-1.25,"degrees":0.125,"explains":true},"exposures":8,)"
            R"("seconds":2.0,"files":["out/comparison.png"]})"));
  }

  void verifyDocument() {
    VerifyResult result;
    result.judgement = {Verdict::remeasure, Message::plain("why")};
    result.found.error = 0.25;
    result.found.errorOf = {0.5, 0.25, 0.125, 0.0};
    result.found.adapted = 0.125;
    result.found.changedShare = 0.5;
    result.found.lamp = 0.75;
    result.found.ambient = -0.5;
    result.found.patterns = 9;
    result.found.exposures = 18;
    result.errorThen = 0.0625;
    result.seconds = 2.0;
    result.files = {"out/changed-1.exr"};
    QCOMPARE(
        toJson(result).dump(),
        std::string(R"({"verdict":"remeasure","sentence":"why","error":0.25,"error_then":0.0625,)"
                    R"("error_by_block":{"1":0.5,"2":0.25,"4":0.125,"8":0.0},"error_without_lamp":0.125,)"
                    R"("changed_share":0.5,"lamp":0.75,"ambient":-0.5,"patterns":9,"exposures":18,)"
                    R"("seconds":2.0,"files":["out/changed-1.exr"]})"));
  }

  void evaluateDocument() {
    EvaluateResult result{"corner", {256, 192}, {160, 120}, 0.9, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, {}};
    result.images = {
        {"hills", 0.8, {{Method::none, 14.0, 13.0, 12.0, 11.0, 0.4, 0.5, 17.0, 18.0, 19.0, 0.001}}}};
    QCOMPARE(
        toJson(result).dump(),
        std::string(
            R"({"venue":"corner","projector":[256,192],"camera":[160,120],"reachable":0.9,)"
            R"("transport":{"frobenius":0.1,"row_median":0.2,"row_p95":0.3,"relight_natural":0.4,)"
            R"("relight_random":0.5,"energy":0.6},"images":[{"name":"hills","reachable":0.8,"methods":{"none":)"
            R"({"psnr_reachable":14.0,"psnr_all":13.0,"psnr_encoded_reachable":12.0,"psnr_encoded_all":11.0,)"
            R"("ssim":0.4,"ms_ssim":0.5,"delta_e":18.0,"delta_e_reachable":17.0,"delta_e_p95":19.0,)"
            R"("seconds":0.001}}}]})"));
  }

  void compensateDocument() {
    CompensateResult result{
        Method::mix, 20.0, 0.1, 0.9, 0.5, {"out/pattern.png"}, 4.5, {{Uncorrectable::unlit, 0.25}}};
    QCOMPARE(
        toJson(result).dump(),
        std::string(R"({"method":"mix","psnr_predicted":20.0,"delta_e":4.5,"clipped":0.1,"reachable":0.9,)"
                    R"("uncorrectable":{"unlit":0.25},"seconds":0.5,"files":["out/pattern.png"]})"));
  }

  /// What several views make of it stands in both documents, and in none of one view.
  void contradictionsOfViews() {
    CompensateResult compensated;
    compensated.contradiction = {0.25, {0.5, 0.125}};
    compensated.notes = {Message::plain("they contradict each other")};
    const std::string text = toJson(compensated).dump();
    QVERIFY(text.find(R"("contradiction":{"share":0.25,"views":[0.5,0.125]})") != std::string::npos);
    QVERIFY(text.find(R"("notes":["they contradict each other"])") != std::string::npos);
    EvaluateResult evaluated;
    evaluated.images.resize(2);
    evaluated.images[1].contradiction = {0.25, {0.5, 0.125}};
    const Json images = toJson(evaluated)["images"];
    QVERIFY(!images[0].contains("contradiction"));
    QCOMPARE(images[1]["contradiction"]["share"].get<double>(), 0.25);
  }

  /// What a measurement says of its own errors stands where there was one.
  void expectedErrors() {
    CompensateResult compensated;
    QVERIFY(!toJson(compensated).contains("expected_error"));
    compensated.expectedError = 0.0625;
    QCOMPARE(toJson(compensated)["expected_error"].get<double>(), 0.0625);
    EvaluateResult evaluated;
    evaluated.images.resize(2);
    evaluated.images[1].asExpected = 0.9375;
    const Json images = toJson(evaluated)["images"];
    QVERIFY(!images[0].contains("as_expected"));
    QCOMPARE(images[1]["as_expected"].get<double>(), 0.9375);
  }

  /// Unseen places, and what blended projectors make of it.
  void placesAndProjectors() {
    EvaluateResult result;
    QVERIFY(!toJson(result).contains("seams"));
    result.images.resize(1);
    QVERIFY(!toJson(result)["images"][0].contains("unseen_places"));
    const MethodScore score{Method::refined, 30.0, 29.0, 28.0, 27.0, 0.9, 0.8, 1.5, 2.0, 3.0, 0.001};
    result.images[0].unseen = {{0.5, {score}}};
    result.images[0].blended = score;
    result.images[0].alone = {{0.25, score}, {0.5, std::nullopt}};
    result.images[0].others = {{0.75, {score}, score, {}, {{Rival::robust, 64, score}}}};
    result.seams = {
        {0.25,
         Method::refined,
         {.mean = 0.5, .p95 = 1.5, .elsewhere = 0.375, .elsewhereP95 = 0.75, .edgeP95 = 1.25},
         {.mean = 2.0, .p95 = 4.0, .elsewhere = 1.0, .elsewhereP95 = 3.0, .edgeP95 = 5.0},
         {.mean = 0.25, .p95 = 0.5, .elsewhere = 0.125, .elsewhereP95 = 0.375, .edgeP95 = 0.625}}};
    const Json document = toJson(result), image = document["images"][0];
    QCOMPARE(image["unseen_places"][0]["reachable"].get<double>(), 0.5);
    QCOMPARE(image["unseen_places"][0]["methods"]["refined"]["psnr_reachable"].get<double>(), 30.0);
    QVERIFY(!image["unseen_places"][0].contains("blended"));
    QCOMPARE(image["blended"]["delta_e"].get<double>(), 2.0);
    QCOMPARE(image["alone"][0]["optimum"]["delta_e"].get<double>(), 2.0);
    QCOMPARE(image["alone"][1].dump(), R"({"reachable":0.5})");
    QCOMPARE(image["other_views"][0]["blended"]["psnr_all"].get<double>(), 29.0);
    QCOMPARE(image["other_views"][0]["rivals"]["robust"]["psnr_all"].get<double>(), 29.0);
    QCOMPARE(image["other_views"][0]["rivals"]["robust"]["photographs"].get<int>(), 64);
    QVERIFY(!image.contains("rivals"));
    QCOMPARE(document["seams"][0].dump(),
             std::string(
                 R"({"grey":0.25,"method":"refined","joint":{"mean":0.5,"p95":1.5,"elsewhere":0.375,)"
                 R"("elsewhere_p95":0.75,"edge_p95":1.25},"blended":{"mean":2.0,"p95":4.0,"elsewhere":1.0,)"
                 R"("elsewhere_p95":3.0,"edge_p95":5.0},"roomy":{"mean":0.25,"p95":0.5,"elsewhere":0.125,)"
                 R"("elsewhere_p95":0.375,"edge_p95":0.625}})"));
  }

  void benchDocument() {
    BenchResult result{{"a processor", 2, 1e10, ""}, {{"T p", 0.01, 1e8, 0.5}}};
    QCOMPARE(
        toJson(result).dump(),
        std::string(
            R"({"machine":{"processor":"a processor","threads":2,"copy_bytes_per_second":10000000000.0},)"
            R"("benchmarks":[{"name":"T p","seconds":0.01,"bytes":100000000.0,"share_of_copy":0.5}]})"));
  }

  void engineBenchDocument() {
    BenchResult result{{"a processor", 2, 1e10, "CPU"},
                       {{"CPU: M", 0.01, 1e8, 0.5, 0.008, {{"Eigen CSR", 4.0}, {"SciPy CSR", 5.0}}}},
                       {Message::plain("something was not timed")}};
    Json document = toJson(result);
    QCOMPARE(document["benchmarks"][0]["best"].get<double>(), 0.008);
    QCOMPARE(document["benchmarks"][0]["times_as_fast_as"].dump(),
             std::string(R"({"Eigen CSR":4.0,"SciPy CSR":5.0})"));
    QCOMPARE(document["notes"][0].get<std::string>(), std::string("something was not timed"));
  }

  void inverseBenchDocument() {
    VenueInversion venue;
    venue.venue = "corner";
    venue.ridge = 0.4;
    venue.printed.percolated = true;
    venue.printed.errorMedian = 0.75;
    venue.quality = {{Method::refined, 31.0}, {Method::none, 17.0}};
    Json document = toJson(InverseBenchResult{{venue}});
    QCOMPARE(document["paper"]["error"].dump(), std::string("[0.7,0.8]"));
    const Json& corner = document["venues"][0];
    QCOMPARE(corner["venue"].get<std::string>(), std::string("corner"));
    QCOMPARE(corner["windows"]["ridge"].get<double>(), 0.4);
    QVERIFY(corner["algorithm1"]["percolated"].get<bool>());
    QCOMPARE(corner["algorithm1"]["error_median"].get<double>(), 0.75);
    // From the least knowledge of the light transport to the most.
    QCOMPARE(corner["psnr_reachable"].dump(), std::string(R"({"none":17.0,"refined":31.0})"));
  }

  void whatIsNotFiniteIsNull() {
    CompensateResult result;
    result.psnrPredicted = std::numeric_limits<double>::infinity();
    QVERIFY(toJson(result).dump().find(R"("psnr_predicted":null)") != std::string::npos);
  }
};

QTEST_APPLESS_MAIN(TestJson)
#include "test_json.moc"
