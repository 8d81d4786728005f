#include "scenes/air_shed_materials.h"

#include <utility>

#include "scenes/mesh_edit.h"
#include "scenes/pattern.h"
#include "scenes/pattern_surface.h"
#include "scenes/shapes.h"

namespace macula {
namespace {

TextureUse repeated(int image, float tile_m) {
    TextureUse use;
    use.image = image;
    use.uv_scale_rotation = glm::vec4(1.0F / tile_m, 0.0F, 0.0F, 1.0F / tile_m);
    return use;
}

/// Images of a surface in the scene, to be used by any number of materials.
struct SurfaceImages {
    int color = -1;
    int roughness_metallic = -1;
    int normal = -1;
};

class MaterialMaker {
public:
    explicit MaterialMaker(SceneBuilder& builder) : builder_(builder) {}

    SurfaceImages images(SurfaceMaps maps) {
        const auto add = [this](TextureImage& image) {
            return image.texels.empty() ? -1 : builder_.add_image(std::move(image));
        };
        return {add(maps.color), add(maps.roughness_metallic), add(maps.normal)};
    }

    /// A surface that repeats every `tile_m`, multiplied with an sRGB colour.
    Material surface(const std::string& name, const SurfaceImages& images, float tile_m,
                     std::uint32_t hex = 0xFFFFFF) const {
        Material m;
        m.name = name;
        m.base_color = linear(hex);
        m.base_color_texture = repeated(images.color, tile_m);
        m.metallic = 0.0F;
        m.roughness = 0.8F;
        if (images.roughness_metallic >= 0) {
            m.metallic_roughness_texture = repeated(images.roughness_metallic, tile_m);
            m.metallic = 1.0F;
            m.roughness = 1.0F;
        }
        if (images.normal >= 0) m.normal_texture = repeated(images.normal, tile_m);
        return m;
    }

    int add(Material m) { return builder_.add_material(std::move(m)); }

    int glowing(const std::string& name, const glm::vec3& radiance) {
        Material m;
        m.name = name;
        m.base_color = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
        m.metallic = 0.0F;
        m.emissive = radiance;
        return add(std::move(m));
    }

private:
    SceneBuilder& builder_;
};

std::vector<DecalText> decal_texts() {
    std::vector<DecalText> texts(static_cast<std::size_t>(AirShedText::count));
    const auto set = [&texts](AirShedText which, DecalText text) {
        texts[static_cast<std::size_t>(which)] = std::move(text);
    };
    set(AirShedText::hangar, {"HANGAR 3", 88});
    set(AirShedText::registration, {"MC-1512", 88, glm::vec3(0.95F), false});
    set(AirShedText::trainer_number, {"47", 96, glm::vec3(0.95F), false});
    set(AirShedText::no_smoking, {"NO SMOKING", 64});
    set(AirShedText::danger_propeller, {"DANGER PROPELLER", 40});
    set(AirShedText::bay_1, {"BAY 1", 64});
    set(AirShedText::bay_2, {"BAY 2", 64});
    set(AirShedText::bay_3, {"BAY 3", 64});
    set(AirShedText::keep_clear, {"KEEP CLEAR", 60});
    set(AirShedText::max_load, {"MAX 500 KG", 44});
    set(AirShedText::fire_point, {"FIRE POINT", 44});
    set(AirShedText::oil, {"OIL SAE 60", 44});
    set(AirShedText::flammable, {"FLAMMABLE", 40});
    set(AirShedText::fragile, {"FRAGILE", 44});
    set(AirShedText::this_side_up, {"THIS SIDE UP", 36});
    set(AirShedText::spares, {"SPARES 1680/07", 36});
    set(AirShedText::engine_shop, {"ENGINE SHOP", 44});
    set(AirShedText::exit, {"EXIT", 44});
    set(AirShedText::no_step, {"NO STEP", 28, glm::vec3(0.95F), false});
    set(AirShedText::fuel, {"FUEL 100/130", 28, glm::vec3(0.95F), false});
    set(AirShedText::hoist, {"2 T", 52});
    set(AirShedText::crew_only, {"CREW ONLY", 40});
    return texts;
}

}  // namespace

AirShedMaterials add_air_shed_materials(SceneBuilder& builder) {
    AirShedMaterials m;
    MaterialMaker make(builder);
    const WearNoise noise;

    m.concrete = make.add(make.surface("concrete", make.images(make_concrete_surface(1024, noise)), 2.5F));
    m.joint = builder.plain("joint sealant", 0x2C2A27, 0.9F);

    const SurfaceImages marking = make.images(make_worn_marking_surface(512, noise));
    Material paint = make.surface("road paint", marking, 2.0F);
    paint.alpha_mode = AlphaMode::mask;
    m.marking = make.add(std::move(paint));

    DecalSheet sheet = make_decal_sheet(1024, decal_texts(), noise.grain);
    for (std::size_t i = 0; i < sheet.places.size(); ++i) m.text[i] = sheet.places[i];
    Material decal;
    decal.name = "stencil paint";
    decal.metallic = 0.0F;
    decal.roughness = 0.6F;
    decal.alpha_mode = AlphaMode::mask;
    decal.base_color_texture.image = builder.add_image(std::move(sheet.image));
    decal.base_color_texture.wrap_u = decal.base_color_texture.wrap_v = TextureWrap::clamp_to_edge;
    m.decal = make.add(std::move(decal));

    const auto sheet_of = [&](const std::string& name, const SurfaceImages& images) {
        Material material = make.surface(name, images, 3.0F);
        material.double_sided = true;
        return make.add(std::move(material));
    };
    m.wall_sheet = sheet_of("wall sheet", make.images(make_rusty_sheet_surface(1024, noise, srgb(0xA9AD98))));
    m.door_sheet = sheet_of("door sheet", make.images(make_rusty_sheet_surface(1024, noise, srgb(0x5E7A80))));
    m.roof_sheet = sheet_of("roof sheet", make.images(make_zinc_surface(1024, noise)));
    m.brick = make.add(make.surface("brick", make.images(make_brick_surface(1024, noise)), 1.2F));
    m.skylight = make.glowing("skylight", glm::vec3(2.3F, 2.25F, 1.9F));
    Material& skylight = builder.scene().materials.back();
    skylight.double_sided = true;
    skylight.alpha_mode = AlphaMode::blend;  // what it covers not, the sun shines through
    skylight.base_color = glm::vec4(0.7F, 0.68F, 0.55F, 0.66F);
    skylight.roughness = 0.8F;

    const SurfaceImages chipped = make.images(make_chipped_paint_surface(1024, noise, 0.45F));
    const SurfaceImages worn = make.images(make_chipped_paint_surface(512, noise, 0.7F));
    m.girder = make.add(make.surface("girder paint", chipped, 1.6F, 0x8A9488));
    m.window_frame = make.add(make.surface("window frame", worn, 1.0F, 0x5A655E));
    m.red = make.add(make.surface("red paint", chipped, 0.8F, 0xC43A2B));
    m.yellow = make.add(make.surface("yellow paint", chipped, 0.9F, 0xE9B23A));
    m.blue = make.add(make.surface("blue paint", worn, 0.9F, 0x3C6E96));
    m.orange = make.add(make.surface("orange paint", chipped, 0.8F, 0xE0702A));
    m.grey = make.add(make.surface("grey paint", chipped, 0.9F, 0x8D9196));
    m.green = make.add(make.surface("green paint", worn, 0.9F, 0x55705A));
    m.white = make.add(make.surface("white paint", chipped, 1.1F, 0xEDE9DE));

    const SurfaceImages steel = make.images(make_worn_steel_surface(512, noise));
    m.steel = make.add(make.surface("steel", steel, 0.7F));
    m.black_iron = make.add(make.surface("black iron", steel, 0.7F, 0x6A6866));
    m.galvanized = make.add(make.surface("galvanized", steel, 1.5F, 0xE8ECEE));
    m.chrome = builder.plain("chrome", 0xD6D8DA, 0.12F, 1.0F);
    m.brass = builder.plain("brass", 0xC9A25A, 0.3F, 1.0F);

    const SurfaceImages planks = make.images(make_plank_surface(1024, noise));
    m.planks = make.add(make.surface("planks", planks, 1.2F));
    m.plywood = make.add(make.surface("plywood", planks, 2.4F, 0xD9B98C));
    m.cardboard = make.add(make.surface("cardboard", make.images(make_cardboard_surface(512, noise)), 0.6F));
    m.rubber = builder.plain("rubber", 0x26262A, 0.85F);
    m.rope = builder.plain("rope", 0xB59D72, 0.95F);
    m.canvas = builder.plain("canvas", 0x6D6C54, 0.95F);
    m.black = builder.plain("black", 0x17181A, 0.6F);
    m.plastic_white = builder.plain("enamel", 0xE6E4DC, 0.3F);

    const SurfaceImages skin = make.images(make_aircraft_skin_surface(1024, noise));
    m.skin = make.add(make.surface("aluminium skin", skin, 2.0F));
    Material yellow = make.surface("yellow skin", skin, 2.0F, 0xF0B323);
    yellow.metallic_roughness_texture = {};
    yellow.metallic = 0.0F;
    yellow.roughness = 0.38F;
    m.painted_skin = make.add(std::move(yellow));
    m.glare_paint = builder.plain("anti-glare paint", 0x2E332C, 0.85F);
    m.aircraft_red = builder.plain("aircraft red", 0xA3231F, 0.35F);

    Material glass;
    glass.name = "canopy glass";
    glass.base_color = linear(0xEEF6F2);
    glass.metallic = 0.0F;
    glass.roughness = 0.05F;
    glass.transmission = 1.0F;
    glass.double_sided = true;
    m.canopy = make.add(glass);
    glass.name = "bottle glass";
    glass.base_color = linear(0xFFFFFF);
    glass.double_sided = false;
    glass.thickness_m = 0.05F;
    glass.attenuation_distance_m = 0.04F;
    glass.attenuation_color = glm::vec3(0.25F, 0.62F, 0.34F);
    m.bottle_glass = make.add(glass);

    Material pane;
    pane.name = "window pane";
    pane.metallic = 0.0F;
    pane.roughness = 0.1F;
    pane.double_sided = true;
    pane.alpha_mode = AlphaMode::blend;
    pane.base_color_texture.image = builder.add_image(make_pane_surface(256, noise).color);
    m.pane = make.add(std::move(pane));

    m.lamp_glow = make.glowing("lamp glow", glm::vec3(14.0F, 9.6F, 5.2F));
    m.tube_glow = make.glowing("tube glow", glm::vec3(5.2F, 5.6F, 5.4F));
    m.red_glow = make.glowing("red glow", glm::vec3(2.4F, 0.15F, 0.1F));
    Material paper;
    paper.name = "paper";
    paper.metallic = 0.0F;
    paper.roughness = 0.9F;
    paper.base_color_texture.image = builder.add_image(make_text_page(512));
    m.paper = make.add(std::move(paper));
    m.asphalt = builder.plain("apron", 0x9A958C, 0.9F);
    m.grass = builder.plain("grass", 0x7C8552, 0.95F);
    m.foliage = builder.plain("foliage", 0x55663F, 0.95F);
    return m;
}

Mesh make_decal(const AirShedMaterials& materials, AirShedText text, float height_m, const glm::vec3& color) {
    const DecalPlace& place = materials.text[static_cast<std::size_t>(text)];
    const float width_m = place.aspect * height_m;
    Mesh quad = make_quad({-0.5F * width_m, 0.5F * height_m, 0.0F}, {width_m, 0.0F, 0.0F}, {0.0F, -height_m, 0.0F});
    for (glm::vec2& uv : quad.uv0) uv = glm::mix(place.uv_low, place.uv_high, uv);
    tint(quad, color);
    return quad;
}

}  // namespace macula
