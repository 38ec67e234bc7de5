/* test_exr_read_chroma.cpp -- an EXR of luminance and chroma, which only the
 * C++ library writes. */
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
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

extern "C" void join_chroma(const char *path, const char *single);

/* A part of numbers, then the picture of another file as the second part. */
extern "C" void
join_chroma(const char *path, const char *single)
{
    Imf::InputFile from(single);
    Imf::Header headers[2] = {from.header(), from.header()};
    const Imath::Box2i box = from.header().dataWindow();
    const int width = box.max.x - box.min.x + 1;
    std::vector<float> depth(size_t(width), 1.0f);
    Imf::FrameBuffer frame;

    headers[0].channels() = Imf::ChannelList();
    headers[0].channels().insert("Z", Imf::Channel(Imf::FLOAT));
    for (int i = 0; i < 2; ++i)
    {
        headers[i].setName(i == 0 ? "depth" : "colour");
        headers[i].setType(Imf::SCANLINEIMAGE);
    }
    Imf::MultiPartOutputFile file(path, headers, 2);
    Imf::OutputPart numbers(file, 0), colour(file, 1);

    frame.insert(
        "Z", Imf::Slice(
                 Imf::FLOAT, reinterpret_cast<char *>(depth.data() - box.min.x),
                 sizeof(float), 0));
    numbers.setFrameBuffer(frame);
    numbers.writePixels(box.max.y - box.min.y + 1);
    colour.copyPixels(from);
}
