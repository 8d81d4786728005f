// The detection experiment: its schedule, its course and its table.

#include "client/study/study.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace macula {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(Schedule, IsTheSameEverywhere) {
    // The same table stands in tests/study/schedule_test.py.
    StudySettings settings;
    settings.masks = {"54", "41", "27", "18"};
    settings.length_s = 45.0;
    settings.seed = 7;
    const std::vector<MaskChange> expected = {{20.000000, 1}, {23.067153, 3}, {28.398874, 1},
                                              {32.396600, 2}, {36.708907, 0}, {41.361473, 1}};
    const auto schedule = make_schedule(settings);
    ASSERT_EQ(schedule.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(schedule[i].at_s, expected[i].at_s, 1e-6) << i;
        EXPECT_EQ(schedule[i].mask, expected[i].mask) << i;
    }
}

TEST(Schedule, DrawsEvenlyAmongTheOthersAndInItsIntervals) {
    const char* chosen = std::getenv("MACULA_SEED");
    StudySettings settings;
    settings.seed = chosen != nullptr ? std::strtoull(chosen, nullptr, 10) : std::random_device{}();
    SCOPED_TRACE("MACULA_SEED=" + std::to_string(settings.seed));
    settings.masks = {"full", "54", "27", "18"};  // the reference may come back
    settings.length_s = 60'000.0;
    const auto schedule = make_schedule(settings);
    EXPECT_EQ(schedule.front().at_s, settings.begin_s);
    EXPECT_NE(schedule.front().mask, 0U);
    std::map<std::pair<std::size_t, std::size_t>, int> pairs;
    double sum_s = 0.0;
    double squares = 0.0;
    for (std::size_t i = 1; i < schedule.size(); ++i) {
        const double interval_s = schedule[i].at_s - schedule[i - 1].at_s;
        ASSERT_GE(interval_s, 3.0);
        ASSERT_LE(interval_s, 7.0);
        sum_s += interval_s;
        squares += (interval_s - 5.0) * (interval_s - 5.0);
        ++pairs[{schedule[i - 1].mask, schedule[i].mask}];
    }
    EXPECT_LT(schedule.back().at_s, settings.length_s);
    const auto count = static_cast<double>(schedule.size() - 1);
    ASSERT_GT(count, 10'000.0);
    // Six standard errors of an even distribution, whose variance is spread^2 / 3.
    EXPECT_NEAR(sum_s / count, 5.0, 6.0 * std::sqrt(4.0 / 3.0 / count));
    EXPECT_NEAR(squares / count, 4.0 / 3.0, 0.1);
    EXPECT_EQ(pairs.size(), 12U) << "every mask follows every other, and none itself";
    for (const auto& [pair, times] : pairs)
        EXPECT_NEAR(times, count / 12.0, 6.0 * std::sqrt(count / 12.0)) << pair.first << " -> " << pair.second;
}

TEST(Schedule, SaysWhatIsWrong) {
    const auto refused = [](auto change) {
        StudySettings settings;
        EXPECT_TRUE(check_study(settings));
        change(settings);
        const auto checked = check_study(settings);
        EXPECT_FALSE(checked);
        return checked ? std::string() : checked.error().message;
    };
    EXPECT_NE(refused([](StudySettings& s) { s.masks.clear(); }).find("mask"), std::string::npos);
    EXPECT_NE(refused([](StudySettings& s) { s.masks = {"27", "54", "27"}; }).find("twice"), std::string::npos);
    EXPECT_NE(refused([](StudySettings& s) { s.masks = {s.reference}; }).find("reference"), std::string::npos);
    EXPECT_NE(refused([](StudySettings& s) { s.masks = {"law:alpha=1,e2=2"}; }).find("alpha"), std::string::npos);
    EXPECT_NE(refused([](StudySettings& s) { s.spread_s = s.interval_s; }).find("spread"), std::string::npos);
    EXPECT_NE(refused([](StudySettings& s) { s.length_s = s.begin_s; }).find("ends"), std::string::npos);
    EXPECT_NE(refused([](StudySettings& s) { s.begin_s = std::nan(""); }).find("reference"), std::string::npos);
    EXPECT_NE(refused([](StudySettings& s) { s.interval_s = 0.0; }).find("interval"), std::string::npos);
}

/// A study of two masks, the time being as the test says.
class StudyTest : public ::testing::Test {
protected:
    static StudySettings settings() {
        StudySettings settings;
        settings.masks = {"54", "18"};
        settings.begin_s = 10.0;
        settings.interval_s = 4.0;
        settings.spread_s = 0.0;
        settings.length_s = 20.0;
        return settings;
    }
    StudyTest() { welcome_.scene_name = "a room, rather dark"; }
    ~StudyTest() override { std::filesystem::remove(path_); }

    /// A frame of this choice is shown at this time of the test.
    Expected<void> show(std::uint32_t choice, double time_s, std::uint64_t connection = 1) {
        Frame frame;
        frame.choice = choice;
        return study_.shown(frame, connection, welcome_, at(time_s));
    }
    static std::int64_t at(double time_s) { return 1000 * kSecond_ns + std::llround(1e9 * time_s); }
    std::string table() {
        EXPECT_TRUE(study_.close(at(120.0)));
        std::ifstream file(path_);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    const std::string path_ =
        (std::filesystem::path(testing::TempDir()) /
         ("macula_study_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".csv"))
            .string();
    Study study_{settings(), StudyLog::open(path_).value()};
    Welcome welcome_;
};

TEST_F(StudyTest, BeginsWhenAllMasksAreReadyAndLogsWhatIsShown) {
    const auto preparations = study_.due(at(0.0));
    ASSERT_EQ(preparations.size(), 2U);
    for (const Choose& choice : preparations) EXPECT_TRUE(choice.only_prepare);
    EXPECT_EQ(preparations[0].sampling, "54");
    EXPECT_EQ(preparations[1].sampling, "18");
    EXPECT_TRUE(study_.due(at(1.0)).empty());

    ASSERT_TRUE(show(0, 50.0));
    ASSERT_TRUE(study_.answered({1, ""}));
    ASSERT_TRUE(show(0, 60.0));
    EXPECT_FALSE(study_.begun()) << "one mask is not ready";
    study_.key(at(61.0));
    ASSERT_TRUE(study_.answered({2, ""}));
    EXPECT_TRUE(study_.due(at(99.0)).empty());
    ASSERT_TRUE(show(0, 100.0));
    EXPECT_TRUE(study_.begun());

    EXPECT_TRUE(study_.due(at(109.9)).empty());
    const auto first = study_.due(at(110.0));
    ASSERT_EQ(first.size(), 1U);
    EXPECT_FALSE(first[0].only_prepare);
    const std::string first_mask = first[0].sampling;
    const std::string second_mask = first_mask == "54" ? "18" : "54";
    ASSERT_TRUE(show(0, 110.1)) << "still on its way";
    ASSERT_TRUE(show(first[0].id, 110.25));
    ASSERT_TRUE(show(first[0].id, 110.35));
    study_.key(at(110.5));
    EXPECT_TRUE(study_.due(at(111.0)).empty());
    const auto second = study_.due(at(114.0));
    ASSERT_EQ(second.size(), 1U);
    EXPECT_EQ(second[0].sampling, second_mask);
    EXPECT_GT(second[0].id, first[0].id);
    ASSERT_TRUE(show(second[0].id, 114.125));
    EXPECT_FALSE(study_.over(at(119.999)));
    EXPECT_TRUE(study_.over(at(120.0)));
    const std::string scene = ",a room  rather dark\n";
    EXPECT_EQ(table(), "time_s,event,from,to,scene\n0.0000,shown,,full" + scene + "10.2500,shown,full," + first_mask +
                           scene + "10.5000,key," + first_mask + "," + scene + "14.1250,shown," + first_mask + "," +
                           second_mask + scene + "20.0000,end," + second_mask + "," + scene);
}

TEST_F(StudyTest, AfterAPauseOnlyTheNewestChangeIsMade) {
    study_.due(at(0.0));
    for (std::uint32_t id : {1U, 2U}) ASSERT_TRUE(study_.answered({id, ""}));
    ASSERT_TRUE(show(0, 100.0));
    const auto schedule = make_schedule(settings());
    ASSERT_EQ(schedule.size(), 3U);
    const auto due = study_.due(at(115.0));
    ASSERT_EQ(due.size(), 1U);
    EXPECT_EQ(due[0].sampling, settings().masks[schedule[1].mask]);
    EXPECT_TRUE(study_.due(at(115.0)).empty());
}

TEST_F(StudyTest, AMaskThatCannotBeHadEndsIt) {
    study_.due(at(0.0));
    const auto answered = study_.answered({2, "there is no such thing"});
    ASSERT_FALSE(answered);
    EXPECT_EQ(answered.error().code, ErrorCode::refused);
    EXPECT_NE(answered.error().message.find("18"), std::string::npos);
    EXPECT_NE(answered.error().message.find("there is no such thing"), std::string::npos);
}

TEST_F(StudyTest, ALostConnectionEndsIt) {
    study_.due(at(0.0));
    ASSERT_TRUE(show(0, 1.0, 3));
    ASSERT_TRUE(show(0, 2.0, 3));
    const auto shown = show(0, 3.0, 4);
    ASSERT_FALSE(shown);
    EXPECT_EQ(shown.error().code, ErrorCode::network);
    EXPECT_EQ(table(), "time_s,event,from,to,scene\n") << "it never began";
}

}  // namespace
}  // namespace macula
