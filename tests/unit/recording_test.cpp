#include "client/device/recording.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "client/device/recorder.h"
#include "client/device/replay.h"
#include "client/device/salient360.h"
#include "client/device/velocity.h"

namespace macula {
namespace {

constexpr float kDegree_rad = 0.01745329F;
const glm::vec3 kForward(0.0F, 0.0F, -1.0F);

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5F) {
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

std::string own_text(const std::string& rows) {
    return recording_header() + "\n" + rows;
}

TEST(Recording, OwnLayoutIsReadAsWritten) {
    const auto recording = parse_recording(own_text("100,1,2,3,0,0.6,0,0.8,0,0.6,-0.8,0,0,-1,1,0.25\n"), "r.csv");
    ASSERT_TRUE(recording) << recording.error().message;
    ASSERT_EQ(recording->samples.size(), 1U);
    const DeviceSample& sample = recording->samples[0];
    EXPECT_EQ(sample.time_ns, 0);
    EXPECT_EQ(sample.start_from_head.position_m, glm::vec3(1, 2, 3));
    EXPECT_FLOAT_EQ(sample.start_from_head.orientation.y, 0.6F);
    EXPECT_FLOAT_EQ(sample.start_from_head.orientation.w, 0.8F);
    expect_near(sample.gaze[kLeftEye].direction, glm::vec3(0, 0.6F, -0.8F));
    EXPECT_EQ(sample.gaze[kRightEye].confidence, 0.25F);
}

TEST(Recording, BrokenRowsAreCountedAndSkipped) {
    const std::string good = ",0,0,0,0,0,0,1,0,0,-1,0,0,-1,1,1\n";
    const auto recording = parse_recording(own_text("# comment\n0" + good + "1,2,3\n" + "4" + good + "4" + good + "\n" +
                                                    "x" + good + "9,0,0,0,0,0,0,7,0,0,-1,0,0,-1,1,1\n12" + good),
                                           "r.csv");
    ASSERT_TRUE(recording);
    EXPECT_EQ(recording->samples.size(), 3U);
    EXPECT_EQ(recording->skipped_rows, 4U);
    EXPECT_EQ(recording->first_problem, "line 4: the row has another number of fields than the header");
}

TEST(Recording, ErrorsNameFileAndLine) {
    const auto unknown = parse_recording("\nfoo,bar\n1,2\n", "r.csv");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().code, ErrorCode::input_file);
    EXPECT_NE(unknown.error().message.find("r.csv:2"), std::string::npos);
    const auto unusable = parse_recording(own_text("oops\n"), "r.csv");
    ASSERT_FALSE(unusable);
    EXPECT_NE(unusable.error().message.find("r.csv"), std::string::npos);
    EXPECT_NE(unusable.error().message.find("line 2"), std::string::npos);
    EXPECT_FALSE(parse_recording("", "r.csv"));
    EXPECT_EQ(load_recording("/nonexistent/r.csv").error().code, ErrorCode::input_file);
    EXPECT_EQ(load_recording("/").error().code, ErrorCode::input_file);
}

TEST(Recording, UnityEulerAnglesBecomeOurRotation) {
    // Unity: positive yaw turns right, positive pitch looks down, positive roll tips the head to the left.
    expect_near(from_unity_euler(0, 90, 0) * kForward, glm::vec3(1, 0, 0));
    expect_near(from_unity_euler(90, 0, 0) * kForward, glm::vec3(0, -1, 0));
    expect_near(from_unity_euler(0, 0, 90) * glm::vec3(0, 1, 0), glm::vec3(-1, 0, 0));
    // Extrinsic order Z, X, Y: pitch down, then yaw to the right.
    expect_near(from_unity_euler(30, 90, 0) * kForward,
                glm::vec3(std::cos(30 * kDegree_rad), -std::sin(30 * kDegree_rad), 0));
}

TEST(Recording, UnityQuaternionsAgreeWithMirroredVectors) {
    const glm::quat unity = glm::normalize(glm::quat(0.3F, 0.5F, -0.2F, 0.7F));
    const glm::vec3 v(0.2F, -0.4F, 0.9F);
    expect_near(from_unity(unity) * from_unity(v), from_unity(unity * v));
}

TEST(Recording, HeldPosesAreInterpolated) {
    std::vector<DeviceSample> samples(9);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i].time_ns = static_cast<std::int64_t>(i) * 4'000'000;
        samples[i].start_from_head.position_m.x = i < 4 ? 0.0F : i < 8 ? 4.0F : 8.0F;
    }
    interpolate_held_poses(samples);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        EXPECT_NEAR(samples[i].start_from_head.position_m.x, static_cast<float>(i), 1e-5F) << i;
    }
}

TEST(Recording, AHeadThatHoldsStillStays) {
    std::vector<DeviceSample> samples(51);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i].time_ns = static_cast<std::int64_t>(i) * 4'000'000;
    samples[50].start_from_head.position_m.x = 1.0F;
    interpolate_held_poses(samples);
    EXPECT_EQ(samples[37].start_from_head.position_m.x, 0.0F);  // 148 ms of 200
    EXPECT_GT(samples[38].start_from_head.position_m.x, 0.0F);
    EXPECT_EQ(samples[50].start_from_head.position_m.x, 1.0F);
}

TEST(Recording, StartKeepsUpAndForgetsHeading) {
    std::vector<DeviceSample> samples(2);
    samples[0].start_from_head = {from_unity_euler(20, 130, 5), glm::vec3(3, 2, 1)};
    samples[1].start_from_head = {from_unity_euler(0, 140, 0), glm::vec3(3, 2.5F, 1)};
    move_to_start(samples);
    expect_near(samples[0].start_from_head.position_m, glm::vec3(0));
    const glm::vec3 forward = samples[0].start_from_head.direction(kForward);
    expect_near(forward, glm::vec3(0, -std::sin(20 * kDegree_rad), -std::cos(20 * kDegree_rad)));
    expect_near(samples[1].start_from_head.position_m, glm::vec3(0, 0.5F, 0));
    expect_near(samples[1].start_from_head.direction(kForward),
                glm::vec3(std::sin(10 * kDegree_rad), 0, -std::cos(10 * kDegree_rad)));
}

TEST(Replay, KeepsTimesAndEnds) {
    Recording recording;
    recording.samples.resize(3);
    recording.samples[1].time_ns = 4'000'000;
    recording.samples[2].time_ns = 9'000'000;
    const auto replay = make_replay(recording, false);
    replay->begin(1'000'000'000);
    EXPECT_EQ(replay->due_ns(), 1'000'000'000);
    EXPECT_FALSE(replay->next(999'999'999));
    EXPECT_EQ(replay->next(1'000'000'000)->time_ns, 1'000'000'000);
    EXPECT_EQ(replay->due_ns(), 1'004'000'000);
    // Late polls get every sample, at the times of the recording.
    EXPECT_EQ(replay->next(2'000'000'000)->time_ns, 1'004'000'000);
    EXPECT_EQ(replay->next(2'000'000'000)->time_ns, 1'009'000'000);
    EXPECT_FALSE(replay->next(2'000'000'000));
    EXPECT_FALSE(replay->due_ns());
}

TEST(Replay, LoopsAfterOneMeanInterval) {
    Recording recording;
    recording.samples.resize(3);
    recording.samples[1].time_ns = 4'000'000;
    recording.samples[2].time_ns = 8'000'000;
    const auto replay = make_replay(recording, true);
    replay->begin(0);
    std::int64_t expected_ns = 0;
    for (int i = 0; i < 10; ++i) {
        const auto sample = replay->next(1'000'000'000);
        ASSERT_TRUE(sample);
        EXPECT_EQ(sample->time_ns, expected_ns);
        EXPECT_EQ(sample->discontinuity, i % 3 == 0);
        expected_ns += 4'000'000;
    }
}

TEST(Velocity, IsTheMotionsOwn) {
    VelocityEstimator estimator;
    const glm::vec3 axis = glm::normalize(glm::vec3(1, 2, -1));
    HeadVelocity velocity;
    for (int i = 0; i < 20; ++i) {
        const float t = static_cast<float>(i) * 0.004F;
        DeviceSample sample;
        sample.time_ns = i * 4'000'000;
        sample.start_from_head = {glm::angleAxis(1.5F * t, axis), glm::vec3(0.3F * t, 0, -t)};
        velocity = estimator.update(sample);
        if (i == 0) {
            EXPECT_EQ(velocity.linear_m_s, glm::vec3(0.0F));
        }
    }
    expect_near(velocity.linear_m_s, glm::vec3(0.3F, 0, -1), 1e-4F);
    expect_near(velocity.angular_rad_s, 1.5F * axis, 1e-3F);
    DeviceSample jump;
    jump.time_ns = 80'000'000;
    jump.discontinuity = true;
    EXPECT_EQ(estimator.update(jump).angular_rad_s, glm::vec3(0.0F));
}

TEST(Recorder, RoundTrip) {
    const auto path = std::filesystem::path(testing::TempDir()) / "macula_recorder_test.csv";
    std::vector<DeviceSample> written(50);
    for (std::size_t i = 0; i < written.size(); ++i) {
        const float t = static_cast<float>(i) * 0.1F;
        written[i].time_ns = 5'000'000'000 + static_cast<std::int64_t>(i) * 3'333'333;
        written[i].start_from_head = {glm::angleAxis(t, glm::normalize(glm::vec3(t, 1, 0.3F))), glm::vec3(t, -t, 1)};
        written[i].gaze[kLeftEye] = {glm::normalize(glm::vec3(t, 0.1F, -5)), 0.75F};
        written[i].gaze[kRightEye] = {glm::normalize(glm::vec3(-t, 0.1F, -5)), 0.0F};
    }
    auto recorder = Recorder::open(path.string());
    ASSERT_TRUE(recorder);
    for (const DeviceSample& sample : written) (*recorder)->write(sample);
    ASSERT_TRUE((*recorder)->close());
    const auto read = load_recording(path.string());
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->samples.size(), written.size());
    EXPECT_EQ(read->skipped_rows, 0U);
    for (std::size_t i = 0; i < written.size(); ++i) {
        EXPECT_EQ(read->samples[i].time_ns, written[i].time_ns - written[0].time_ns);
        expect_near(read->samples[i].start_from_head.position_m, written[i].start_from_head.position_m, 1e-9F);
        expect_near(read->samples[i].gaze[0].direction, written[i].gaze[0].direction, 1e-6F);
        EXPECT_GT(glm::dot(read->samples[i].start_from_head.orientation, written[i].start_from_head.orientation),
                  1.0F - 1e-6F);
        EXPECT_EQ(read->samples[i].gaze[0].confidence, 0.75F);
        EXPECT_EQ(read->samples[i].gaze[1].confidence, 0.0F);
    }
    std::filesystem::remove(path);
}

TEST(Recorder, UnwritableFileIsAnOutputError) {
    const auto recorder = Recorder::open("/nonexistent/folder/r.csv");
    ASSERT_FALSE(recorder);
    EXPECT_EQ(recorder.error().code, ErrorCode::output);
    const auto full = Recorder::open("/dev/full");
    ASSERT_TRUE(full);
    for (int i = 0; i < 10; ++i) (*full)->write({});
    EXPECT_EQ((*full)->close().error().code, ErrorCode::output);
}

/// A file of the recordings that the project was given, with what is known of it.
struct Given {
    const char* file;
    const char* layout;
    std::size_t rows;
    double seconds;
    double rate_hz;
};

class Salient360 : public testing::TestWithParam<Given> {};

TEST_P(Salient360, IsReadPlausibly) {
    const Given& given = GetParam();
    const std::string path = std::string(MACULA_SOURCE_DIR "/../shared/gaze/") + given.file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
    const auto recording = load_recording(path);
    ASSERT_TRUE(recording) << recording.error().message;
    const auto& samples = recording->samples;
    EXPECT_EQ(recording->layout, given.layout);
    EXPECT_EQ(samples.size() + recording->skipped_rows, given.rows);
    EXPECT_LE(recording->skipped_rows, given.rows / 50) << recording->first_problem;
    const double seconds = static_cast<double>(samples.back().time_ns) * 1e-9;
    EXPECT_NEAR(seconds, given.seconds, 0.1);
    EXPECT_NEAR(static_cast<double>(samples.size()) / seconds, given.rate_hz, 0.03 * given.rate_hz);

    std::vector<double> eccentricity_deg;
    std::vector<double> head_deg_s;
    VelocityEstimator velocity;
    for (const DeviceSample& sample : samples) {
        const glm::vec3 head_velocity = velocity.update(sample).angular_rad_s;
        head_deg_s.push_back(static_cast<double>(glm::length(head_velocity) / kDegree_rad));
        for (const GazeSample& gaze : sample.gaze) {
            ASSERT_NEAR(glm::length(gaze.direction), 1.0F, 1e-5F);
            if (gaze.confidence == 0.0F) continue;
            ASSERT_LT(gaze.direction.z, 0.0F) << "an eye that looks backwards";
            eccentricity_deg.push_back(static_cast<double>(std::acos(-gaze.direction.z) / kDegree_rad));
        }
    }
    const auto quantile = [](std::vector<double> values, double q) {
        std::ranges::sort(values);
        return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
    };
    const double p50_deg = quantile(eccentricity_deg, 0.5);
    const double p99_deg = quantile(eccentricity_deg, 0.99);
    const double head_p95_deg_s = quantile(head_deg_s, 0.95);
    RecordProperty("eccentricity_p50_deg", std::to_string(p50_deg));
    RecordProperty("eccentricity_p99_deg", std::to_string(p99_deg));
    RecordProperty("head_p95_deg_s", std::to_string(head_p95_deg_s));
    EXPECT_GT(p50_deg, 9.0);
    EXPECT_LT(p50_deg, 19.0);
    EXPECT_GT(p99_deg, 20.0);
    EXPECT_LT(p99_deg, 40.0);
    EXPECT_GT(head_p95_deg_s, 60.0);
    EXPECT_LT(head_p95_deg_s, 170.0);
    // What the first picture shows lies straight ahead in the scene.
    const glm::vec3 forward = samples.front().start_from_head.direction(kForward);
    EXPECT_NEAR(forward.x, 0.0F, 1e-4F);
    EXPECT_LT(forward.z, 0.0F);
}

INSTANTIATE_TEST_SUITE_P(Files, Salient360,
                         testing::Values(Given{"salient360_rawDataDyn1.csv", "Salient360 video", 5150, 20.6, 250},
                                         Given{"salient360_rawDataDyn2.csv", "Salient360 video", 5147, 20.6, 250},
                                         Given{"salient360_rawDataStatic1.csv", "Salient360 scene", 1412, 11.8, 120},
                                         Given{"salient360_rawDataStatic2.csv", "Salient360 scene", 616, 5.1, 120}),
                         [](const auto& file) { return "File" + std::to_string(file.index); });

}  // namespace
}  // namespace macula
