#include "stage.h"

#include <fmt/format.h>

#include <numbers>

namespace nephroid::experiment::stage {

std::string studio(int width, int height) {
    return fmt::format(
        R"(Film "rgb" "integer xresolution" {} "integer yresolution" {}
Scale -1 1 1
LookAt 0 -7.5 3.1  0 0 1.05  0 0 1
Camera "perspective" "float fov" 21
WorldBegin
LightSource "infinite" "rgb L" [ 0.75 0.87 1 ] "float scale" 0.45
AttributeBegin
    AreaLightSource "diffuse" "rgb L" [ 1 0.93 0.83 ] "float scale" 3.4
    Shape "quad" "point3 origin" [ -6 -2.4 4.2 ] "vector3 u" [ 2.3 1.9 2.4 ] "vector3 v" [ 2.6 -3.1 0 ]
AttributeEnd
AttributeBegin
    AreaLightSource "diffuse" "rgb L" [ 0.8 0.9 1 ] "float scale" 5 "bool twosided" true
    Shape "quad" "point3 origin" [ 4.6 -1.2 0.3 ] "vector3 u" [ 0.3 0.8 0 ] "vector3 v" [ 0 0 4.5 ]
AttributeEnd
Texture "tiles" "spectrum" "checkerboard" "float uscale" 64 "float vscale" 64
    "rgb tex1" [ 0.55 0.55 0.55 ] "rgb tex2" [ 0.16 0.17 0.19 ]
Material "diffuse" "texture reflectance" "tiles"
Shape "quad" "point3 origin" [ -24.3 -24.3 0 ] "vector3 u" [ 48 0 0 ] "vector3 v" [ 0 48 0 ]
)",
        width, height);
}

std::string ball_and_plinth(std::string const& shape_parameters) {
    return "AttributeBegin\nRotate 28 0 0 1\nShape \"box\" \"point3 lo\" [ -0.85 -0.85 0.002 ] "
           "\"point3 hi\" [ 0.85 0.85 0.3 ] " +
           shape_parameters +
           "\nAttributeEnd\nAttributeBegin\nTranslate 0 0 1.303\nRotate 20 1 0 0\nShape \"sphere\" " +
           shape_parameters + "\nAttributeEnd\n";
}

std::string ball() {
    return "AttributeBegin\nTranslate 0 0 1.152\nRotate 20 1 0 0\nShape \"sphere\" \"float radius\" "
           "1.15\nAttributeEnd\n";
}

std::string white_sky(int pixels) {
    return fmt::format(
        R"(Option "string color" "rgb"
Film "rgb" "integer xresolution" {0} "integer yresolution" {0}
PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
LookAt 0 -4 0  0 0 0  0 0 1
Camera "orthographic" "float screenwindow" [ -1 1 -1 1 ]
WorldBegin
LightSource "infinite" "rgb L" [ 1 1 1 ]
)",
        pixels);
}

std::string unit_sphere() { return "Shape \"sphere\"\n"; }

double over_disk(Picture const& p) {
    // Of a square's pixels the disk covers pi / 4; the rest is sky, of radiance 1.
    double const disk = std::numbers::pi / 4;
    return (mean(p) - (1 - disk)) / disk;
}

}  // namespace nephroid::experiment::stage
