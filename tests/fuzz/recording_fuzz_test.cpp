#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "client/device/recorder.h"
#include "tests/support/text_mutation.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace macula {
namespace {

void run(const std::string& text) {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

/// One small file of each layout.
std::vector<std::string> corpus() {
    const std::string own = recording_header() + "\n" + recording_row({}) +
                            "\n4000000,0.1,0.2,0.3,0,0.6,0,0.8,0,0,-1,0,0,-1,1,0.5\n"
                            "8000000,0.1,0.2,0.3,0,0.6,0,0.8,0,0,-1,0.6,0,-0.8,0,1\n";
    const std::string video =
        "oculoTS,unityTS,currFrame,LeftPosX,LeftPosY,RightPosX,RightPosY,cam_pitch,cam_yaw,cam_roll,sphere_yaw,"
        "meanGazeDir.x,meanGazeDir.y,meanGazeDir.z,leftBasePt.x,leftBasePt.y,leftBasePt.z,rightBasePt.x,rightBasePt.y,"
        "rightBasePt.z,leftGazeDir.x,leftGazeDir.y,leftGazeDir.z,rightGazeDir.x,rightGazeDir.y,rightGazeDir.z,"
        "binPor.x,binPor.y,Lval,Rval\n"
        "1000,9,0,1,2,3,4,349,294,355,224,0,0,1,0,0,0,0,0,0,0,0.6,0.8,0,0,1,5,6True,True\n"
        "5000,9,0,1,2,3,4,349,294,355,224,0,0,1,0,0,0,0,0,0,NaN,NaN,NaN,0,0,1,5,NaNFalse,True\n"
        "9000,9,0,1,2,3,4,350,295,355,224,0,0,1,0,0,0,0,0,0,0,0.6,0.8,0,0,1,5,6True,False\n";
    const std::string scene =
        "OcutimeStamp,cameraPosition.x,cameraPosition.y,cameraPosition.z,cameraRotation.x,cameraRotation.y,"
        "cameraRotation.z,cameraRotation.w,leftEyeDirection.x,leftEyeDirection.y,leftEyeDirection.z,"
        "rightEyeDirection.x,rightEyeDirection.y,rightEyeDirection.z,valL,valR\n"
        "100,0.4,1.5,0.3,0,0.6,0,0.8,0,0,1,0,0.6,0.8,True,True\n"
        "108,0.4,1.5,0.3,0,0.6,0,0.8,0,0,1,NaN,NaN,NaN,True,False\n"
        "116,0.5,1.5,0.3,0,0.8,0,0.6,0,0,1,0,0.6,0.8,True,True\n";
    return {own, video, scene, "", "\n", "time_ns\n1\n"};
}

const std::vector<std::string> kHostile = {
    "-", "9223372036854775807", "-9223372036854775808", "1e999", "nan", "inf", ",", "\n", "\r", "True", "False", "0"};

TEST(RecordingFuzz, CorpusIsAccepted) {
    for (const std::string& text : corpus()) run(text);
}

TEST(RecordingFuzz, MutationsAreSurvived) {
    const unsigned seed = 1;
    std::mt19937 random(seed);
    for (const std::string& text : corpus()) {
        for (int i = 0; i < 3000; ++i) {
            const std::string hostile = testing::mutated(text, kHostile, random);
            SCOPED_TRACE("seed 1, mutation " + std::to_string(i));
            run(hostile);
        }
    }
}

}  // namespace
}  // namespace macula
