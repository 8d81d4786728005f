// The text that names how frames are made.

#include <gtest/gtest.h>

#include <string>

#include "server/method.h"

namespace macula {
namespace {

TEST(Method, LeavesOutWhatIsUsual) {
    const auto method = parse_method("27");
    ASSERT_TRUE(method) << method.error().message;
    EXPECT_EQ(method->sampler, SamplerKind::tiles);
    EXPECT_EQ(method->reconstruction, Reconstruction::tiles);
    EXPECT_NEAR(method->preset.share, 0.27, 1e-12);
    EXPECT_EQ(method->name, "tiles:27/tiles");
}

TEST(Method, EachSamplerHasAReconstructionOfItsOwn) {
    EXPECT_EQ(parse_method("mesh:27")->reconstruction, Reconstruction::table);
    for (const char* rival : {"uniform:27", "layers:27", "log-polar:27"})
        EXPECT_EQ(parse_method(rival)->reconstruction, Reconstruction::bilinear) << rival;
}

TEST(Method, ItsNameIsReadBackAsItself) {
    for (const char* text :
         {"27", "full", "tiles:full/cells", "mesh:paper-18/raster", "mesh-16:54/push-pull", "mesh:file/nearest",
          "uniform:9.5", "layers:paper-41", "log-polar:watson", "law:e2=5", "mesh:law:e2=5,exponent=1/raster"}) {
        const auto method = parse_method(text);
        ASSERT_TRUE(method) << method.error().message;
        const auto again = parse_method(method->name);
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_EQ(again->name, method->name);
        EXPECT_EQ(again->sampler, method->sampler);
        EXPECT_EQ(again->mesh_step_px, method->mesh_step_px);
        EXPECT_EQ(again->mesh_file, method->mesh_file);
        EXPECT_EQ(again->reconstruction, method->reconstruction);
        EXPECT_EQ(again->preset.name, method->preset.name);
    }
}

TEST(Method, AMeshMayMoveInSteps) {
    EXPECT_EQ(parse_method("mesh:27")->mesh_step_px, 1);
    EXPECT_EQ(parse_method("mesh-16:27")->mesh_step_px, 16);
}

struct Refusal {
    const char* text;
    const char* says;  ///< in the message
};

TEST(Method, AnErrorNamesTheWholeTextAndWhatIsWrongWithIt) {
    for (const Refusal& refusal :
         {Refusal{"spiral:27", "unknown sampler 'spiral'"}, Refusal{"mesh-:27", "unknown sampler 'mesh-'"},
          Refusal{"mesh-0:27", "unknown sampler 'mesh-0'"}, Refusal{"mesh-65:27", "unknown sampler 'mesh-65'"},
          Refusal{"mesh-4x:27", "unknown sampler 'mesh-4x'"}, Refusal{":27", "unknown sampler ''"},
          Refusal{"27/magic", "magic"}, Refusal{"27/", "reconstruction"}, Refusal{"mesh:", "sampling"},
          Refusal{"mesh:127", "127"}, Refusal{"tiles:file", "file"}, Refusal{"", "sampling"},
          Refusal{"27/raster", "only the sampler mesh"}, Refusal{"27/table", "only the sampler mesh"},
          Refusal{"mesh:27/tiles", "only the sampler tiles"}, Refusal{"layers:27/cells", "lie between"},
          Refusal{"log-polar:27/table", "only the sampler mesh"}, Refusal{"mesh:27/bilinear", "rows and columns"},
          Refusal{"log-polar:full", "cannot be all pixels"}}) {
        const auto method = parse_method(refusal.text);
        ASSERT_FALSE(method) << refusal.text;
        EXPECT_EQ(method.error().code, ErrorCode::option);
        const std::string whole = std::string("'").append(refusal.text).append("'");
        EXPECT_NE(method.error().message.find(whole), std::string::npos) << method.error().message;
        EXPECT_NE(method.error().message.find(refusal.says), std::string::npos) << method.error().message;
    }
}

}  // namespace
}  // namespace macula
