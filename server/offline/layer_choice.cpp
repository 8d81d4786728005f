#include <algorithm>

#include "server/offline/writer.h"

namespace macula {

Expected<LayerChoice> parse_layers(const std::string& text) {
    LayerChoice choice;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string name = text.substr(begin, end - begin);
        begin = end + 1;
        bool* layer = nullptr;
        if (name == "color") layer = &choice.color;
        if (name == "depth") layer = &choice.depth;
        if (name == "object") layer = &choice.object;
        if (name == "positions") layer = &choice.positions;
        if (name == "levels") layer = &choice.levels;
        if (layer == nullptr) {
            std::string message = "--write ";
            message.append(text).append(": '").append(name);
            return fail(ErrorCode::option, message + "' is unknown: use color, depth, object, positions and levels");
        }
        *layer = true;
    }
    return choice;
}

}  // namespace macula
