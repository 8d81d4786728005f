#pragma once

#include <functional>
#include <string>

#include "protocol/base/image.h"

namespace macula::test {

// The frame of the stability suite: what every case says of itself, in one place, so that tests/stability/run.sh can
// list them all.

enum class Side {
    at_most,   ///< the figure may be the bound or less
    at_least,  ///< the figure may be the bound or more
};

/// One figure of the suite, and what it may be.
struct Case {
    std::string name;    ///< a path without spaces, from the kind of trouble to the method: signal/saccade/tiles:18
    std::string figure;  ///< what was measured, with its unit in brackets where it has one: "flicker (/255)"
    double value = 0.0;
    Side side = Side::at_most;
    double bound = 0.0;
    std::string reason;  ///< one sentence: why the bound is where it is
};

/// What the client showed and what it should have shown, of one size.
struct CasePictures {
    ColorImage shown;
    ColorImage reference;
};

/// Prints the case as one row of a Markdown table, `| name | figure | value | bound | reason |`, and fails the running
/// test if the value is beyond the bound or not a number. `pictures`, if given, is called only then: shown, reference
/// and difference (PNG) go to a folder of the build tree that the message names.
void check(const Case& measured, const std::function<CasePictures()>& pictures = {});

/// Prints a figure that nothing is asked of, a rival's beside ours, as a row whose bound is empty.
void state(const std::string& name, const std::string& figure, double value, const std::string& remark);

/// Whether the cases that take long are asked for: MACULA_STABILITY=full in the environment.
bool whole_suite();

}  // namespace macula::test

/// Leaves a test that takes long, with a message, unless the whole suite is asked for.
#define MACULA_WHOLE_SUITE_ONLY()                                                                    \
    do {                                                                                             \
        if (!::macula::test::whole_suite()) GTEST_SKIP() << "takes long: set MACULA_STABILITY=full"; \
    } while (false)
