#include "scenes/load.h"

#include "scenes/bunny_box.h"

namespace macula {

Expected<LoadedScene> load_scene(const std::string& name_or_path) {
    if (name_or_path == "bunny-box") return make_bunny_box();
    return fail(ErrorCode::option, "unknown scene \"" + name_or_path + "\"; known is \"bunny-box\"");
}

}  // namespace macula
