# Scenes made by code, and what they are made of.
target_sources(macula_scenes PRIVATE
    air_shed.cpp air_shed_access.cpp air_shed_airframe.cpp air_shed_cladding.cpp air_shed_engine.cpp
    air_shed_equipment.cpp air_shed_floor.cpp air_shed_frames.cpp air_shed_furnish.cpp air_shed_light.cpp
    air_shed_materials.cpp air_shed_openings.cpp air_shed_services.cpp air_shed_storage.cpp air_shed_trainer.cpp
    air_shed_transport.cpp air_shed_workshop.cpp
    mesh_edit.cpp openness.cpp scene_builder.cpp shapes_steel.cpp shapes_surface.cpp shapes_wire.cpp
    pattern_fibre.cpp pattern_glyph.cpp pattern_metal.cpp pattern_mineral.cpp)
