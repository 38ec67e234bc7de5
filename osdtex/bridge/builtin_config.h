/* builtin_config.h -- the colour configuration that osdtex carries.
 *
 * The few spaces that a texture needs, with the names and aliases that the
 * ACES configurations give them, so that a script works with either. The
 * reference is ACES2065-1; linear Rec.709 is reached by the Bradford matrix
 * that OpenColorIO has built in, and is scene_linear: without a configuration
 * that is what every reader takes an EXR to hold, and what OpenEXR says of
 * files without chromaticities. Profile version 2, which OpenColorIO 2.1
 * reads. There is no rule by colour space names in paths: "Raw" is found in
 * "/drawings/brick.png" too. */
#ifndef OTX_BRIDGE_BUILTIN_CONFIG_H
#define OTX_BRIDGE_BUILTIN_CONFIG_H

static const char builtin_config[] = R"ocio(ocio_profile_version: 2

name: osdtex-builtin
description: The spaces that osdtex needs when no configuration is given.
search_path: ""
strictparsing: true
luma: [0.2126, 0.7152, 0.0722]

roles:
  aces_interchange: ACES2065-1
  color_picking: sRGB - Texture
  data: Raw
  default: Raw
  matte_paint: sRGB - Texture
  reference: ACES2065-1
  rendering: Linear Rec.709 (sRGB)
  scene_linear: Linear Rec.709 (sRGB)
  texture_paint: sRGB - Texture

file_rules:
  - !<Rule> {name: Data, colorspace: Raw, regex: ".*[._](raw|nrm|normal|disp|displacement|height|mask)[._][^/]*"}
  - !<Rule> {name: Default, colorspace: default}

displays:
  sRGB:
    - !<View> {name: Un-tone-mapped, colorspace: sRGB - Texture}
    - !<View> {name: Raw, colorspace: Raw}

active_displays: [sRGB]
active_views: [Un-tone-mapped, Raw]

colorspaces:
  - !<ColorSpace>
    name: ACES2065-1
    aliases: [aces2065_1, ACES - ACES2065-1, lin_ap0, lin_ap0_scene]
    family: ACES
    encoding: scene-linear
    bitdepth: 32f
    isdata: false
    description: Linear light, AP0 primaries, ACES white.

  - !<ColorSpace>
    name: ACEScg
    aliases: [ACES - ACEScg, lin_ap1, lin_ap1_scene]
    family: ACES
    encoding: scene-linear
    bitdepth: 32f
    isdata: false
    description: Linear light, AP1 primaries, ACES white.
    to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}

  - !<ColorSpace>
    name: Linear Rec.709 (sRGB)
    aliases: [lin_rec709_srgb, lin_rec709, lin_rec709_scene, lin_srgb, Utility - Linear - Rec.709, Utility - Linear - sRGB]
    family: Utility
    encoding: scene-linear
    bitdepth: 32f
    isdata: false
    description: Linear light, Rec.709 primaries, D65 white.
    from_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: ACEScg_to_ACES2065-1, direction: inverse}
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD}

  - !<ColorSpace>
    name: sRGB - Texture
    aliases: [srgb_texture, srgb_tx, srgb_rec709_scene, sRGB, "sRGB Encoded Rec.709 (sRGB)", Utility - sRGB - Texture]
    family: Utility
    encoding: sdr-video
    bitdepth: 32f
    isdata: false
    description: Rec.709 primaries with the sRGB curve, scene-referred.
    from_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: ACEScg_to_ACES2065-1, direction: inverse}
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD}
        - !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}

  - !<ColorSpace>
    name: Raw
    aliases: [Utility - Raw]
    family: Utility
    encoding: data
    bitdepth: 32f
    isdata: true
    description: Data that is not colour and is never converted.
)ocio";

#endif
