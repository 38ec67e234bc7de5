/* test_exr_read_chroma.cpp -- an EXR of luminance and chroma, which only the
 * C++ library writes. */
#include <ImfRgbaFile.h>

#include <vector>

extern "C" void write_chroma(
    const char *path, const float *rgb, int width, int height, bool alpha);

/*   rgb  [width * height * 3], top row first */
extern "C" void
write_chroma(
    const char *path, const float *rgb, int width, int height, bool alpha)
{
    std::vector<Imf::Rgba> pixels;

    for (int i = 0; i < width * height; ++i)
        pixels.emplace_back(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2], .5f);
    Imf::RgbaOutputFile file(
        path, width, height, alpha ? Imf::WRITE_YCA : Imf::WRITE_YC);
    file.setFrameBuffer(pixels.data(), 1, size_t(width));
    file.writePixels(height);
}
