// Which method a client gets when it chooses, and what it is told.

#include "server/service/method_choices.h"

#include <chrono>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/render_fakes.h"

namespace macula {
namespace {

using namespace std::chrono_literals;

/// Choices among the methods of one letter; counts how often each was made.
class MethodChoicesTest : public ::testing::Test {
protected:
    Expected<std::unique_ptr<MethodParts>> make(const std::string& sampling) {
        ++made_[sampling];
        if (sampling.size() != 1) return fail(ErrorCode::option, "no method " + sampling);
        auto method = std::make_unique<MethodParts>();
        method->reconstructor = std::make_unique<testing::FakeReconstructor>();
        return method;
    }

    /// Asks, and makes what was asked for.
    Chosen choose(std::uint32_t id, const std::string& sampling, bool only_prepare = false) {
        EXPECT_FALSE(choices_.ask({id, sampling, only_prepare}));
        return choices_.make_next(0ms).value();
    }

    std::map<std::string, int> made_;
    MethodChoices choices_{[this](const std::string& sampling) { return make(sampling); }};
};

TEST_F(MethodChoicesTest, AMethodThatWasPreparedIsNotMadeAgain) {
    EXPECT_EQ(choose(1, "a", true).problem, "");
    EXPECT_FALSE(choices_.take()) << "it was only prepared";
    EXPECT_EQ(choose(2, "b").problem, "");
    const auto b = choices_.take();
    ASSERT_TRUE(b);
    EXPECT_EQ(b->choice, 2U);
    EXPECT_FALSE(choices_.take()) << "once";
    EXPECT_EQ(choose(3, "a").id, 3U);
    const auto a = choices_.take();
    ASSERT_TRUE(a);
    EXPECT_NE(a->method, b->method);
    choose(4, "b");
    EXPECT_EQ(choices_.take()->method, b->method);
    EXPECT_EQ(made_, (std::map<std::string, int>{{"a", 1}, {"b", 1}}));
}

TEST_F(MethodChoicesTest, AnUnknownMethodChangesNothing) {
    choose(1, "a");
    EXPECT_EQ(choose(2, "nonsense").problem, "no method nonsense");
    EXPECT_EQ(choices_.take()->choice, 1U);
    EXPECT_EQ(choose(3, "a").problem, "");
    EXPECT_EQ(made_["a"], 1);
}

TEST_F(MethodChoicesTest, TheNewestWins) {
    choose(1, "a");
    choose(2, "b");
    EXPECT_EQ(choices_.take()->choice, 2U);
    EXPECT_FALSE(choices_.take());
}

TEST_F(MethodChoicesTest, ThoseAskedForLastAreKept) {
    std::uint32_t id = 0;
    for (char name = 'a'; name < 'a' + static_cast<int>(MethodChoices::kMostKept); ++name)
        choose(++id, std::string(1, name));
    choose(++id, "a");  // now b is the oldest
    choose(++id, "z");
    choose(++id, "a");
    EXPECT_EQ(made_["a"], 1);
    choose(++id, "b");
    EXPECT_EQ(made_["b"], 2);
}

TEST_F(MethodChoicesTest, ALineThatIsFullIsAnswered) {
    for (std::uint32_t id = 1; id <= MethodChoices::kMostWaiting; ++id) ASSERT_FALSE(choices_.ask({id, "a", false}));
    const auto answer = choices_.ask({99, "a", false});
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->id, 99U);
    EXPECT_NE(answer->problem, "");
    EXPECT_EQ(choices_.make_next(0ms)->id, 1U);
    EXPECT_FALSE(choices_.ask({100, "a", false}));
    choices_.close();
    EXPECT_FALSE(choices_.make_next(10s)) << "nothing is made for who has gone, and nobody waits";
}

}  // namespace
}  // namespace macula
