/* openexr.cpp -- what OpenEXR reads in C++ only, for C.
 *
 * Rows come one at a time into a buffer of one row: OpenEXR keeps the block
 * that it decompressed last. No thread of OpenEXR's own is used. */
#include "bridge/openexr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

struct window
{
    int32_t x_min, width;
};

window
window_of(const Imath::Box2i &box)
{
    return {box.min.x, box.max.x - box.min.x + 1};
}

/* Slices of the channels that there are, one for each name. Base pointers are
 * those of pixel (0, 0), which may lie outside of the buffer; rows overlay each
 * other. */
Imf::FrameBuffer
frame_buffer(const otx_openexr_picture &p, window w, std::vector<float> *row)
{
    const size_t pixel = 4 * sizeof(float);
    Imf::FrameBuffer frame;

    for (int c = 0; c < 4; ++c)
        if (p.channels[c] && !frame.findSlice(p.channels[c]))
            frame.insert(
                p.channels[c], Imf::Slice(
                                   Imf::FLOAT,
                                   reinterpret_cast<char *>(row->data() + c) -
                                       ptrdiff_t(pixel) * w.x_min,
                                   pixel, 0));
    return frame;
}

/* The same channel in several places, and the alpha of those that have none. */
void
complete_row(const otx_openexr_picture &p, std::vector<float> *row)
{
    for (int c = 1; c < 4; ++c)
    {
        int from = 0;

        while (from < c && p.channels[c] &&
               std::strcmp(p.channels[from], p.channels[c]) != 0)
            ++from;
        for (size_t i = 0; i < row->size(); i += 4)
            if (!p.channels[c])
                (*row)[i + size_t(c)] = 1.0f;
            else if (from < c)
                (*row)[i + size_t(c)] = (*row)[i + size_t(from)];
    }
}

void
read_channels(const otx_openexr_picture &p, otx_openexr_sink sink, void *user)
{
    Imf::MultiPartInputFile file(p.path, 0);
    Imf::InputPart part(file, p.part);
    const window w = window_of(part.header().dataWindow());
    std::vector<float> row(4 * size_t(w.width));

    part.setFrameBuffer(frame_buffer(p, w, &row));
    for (int32_t y = p.y_min; y <= p.y_max; ++y)
    {
        part.readPixels(y, y);
        complete_row(p, &row);
        sink(user, y, row.data(), w.x_min, w.width);
    }
}

/* A file in memory, to be written. */
class sheet : public Imf::OStream
{
  public:
    sheet() : OStream("part")
    {
    }
    void write(const char *from, int count) override
    {
        if (at + size_t(count) > bytes.size())
            bytes.resize(at + size_t(count));
        std::copy(from, from + count, bytes.begin() + ptrdiff_t(at));
        at += size_t(count);
    }
    uint64_t tellp() override
    {
        return at;
    }
    void seekp(uint64_t to) override
    {
        at = size_t(to);
    }

    std::string bytes;

  private:
    size_t at = 0;
};

/* And to be read. */
class reading : public Imf::IStream
{
  public:
    explicit reading(const std::string &all) : IStream("part"), bytes(all)
    {
    }
    bool read(char *to, int count) override
    {
        if (size_t(count) > bytes.size() - at)
            throw std::runtime_error("the part ends early");
        std::copy_n(bytes.begin() + ptrdiff_t(at), count, to);
        at += size_t(count);
        return at < bytes.size();
    }
    uint64_t tellg() override
    {
        return at;
    }
    void seekg(uint64_t to) override
    {
        at = std::min(size_t(to), bytes.size());
    }

  private:
    const std::string &bytes;
    size_t at = 0;
};

/* A part as a file of its own, block by block as they are. */
void
copy_part(Imf::MultiPartInputFile &file, int index, sheet *out)
{
    const std::set<std::string> of_parts = {
        "name", "type", "view", "chunkCount"};
    Imf::InputPart part(file, index);
    Imf::Header header;

    // Header::erase() of OpenEXR 3.1 leaks what it erases.
    for (auto a = part.header().begin(); a != part.header().end(); ++a)
        if (of_parts.count(a.name()) == 0)
            header.insert(a.name(), a.attribute());
    Imf::OutputFile alone(*out, header, 0);
    alone.copyPixels(part);
}

void
read_chroma_of(
    Imf::RgbaInputFile &file, const otx_openexr_picture &p,
    otx_openexr_sink sink, void *user)
{
    const window w = window_of(file.dataWindow());
    std::vector<Imf::Rgba> pixels(static_cast<size_t>(w.width));
    std::vector<float> row(4 * size_t(w.width));

    file.setFrameBuffer(pixels.data() - w.x_min, 1, 0);
    for (int32_t y = p.y_min; y <= p.y_max; ++y)
    {
        file.readPixels(y, y);
        for (size_t i = 0; i < pixels.size(); ++i)
        {
            row[4 * i] = pixels[i].r;
            row[4 * i + 1] = pixels[i].g;
            row[4 * i + 2] = pixels[i].b;
            row[4 * i + 3] = pixels[i].a;
        }
        sink(user, y, row.data(), w.x_min, w.width);
    }
}

/* OpenEXR's own reconstruction of chroma, and its weights from the header's
 * chromaticities. It takes files of one part. */
void
read_chroma(const otx_openexr_picture &p, otx_openexr_sink sink, void *user)
{
    Imf::MultiPartInputFile parts(p.path, 0);

    if (parts.parts() == 1)
    {
        Imf::RgbaInputFile file(p.path, 0);

        read_chroma_of(file, p, sink, user);
        return;
    }

    sheet alone;

    copy_part(parts, p.part, &alone);

    reading stream(alone.bytes);
    Imf::RgbaInputFile file(stream, 0);

    read_chroma_of(file, p, sink, user);
}

/* What OpenEXR says may quote bytes of the file. */
void
keep_reason(const char *what, char reason[OTX_OPENEXR_REASON_BYTES])
{
    std::snprintf(reason, OTX_OPENEXR_REASON_BYTES, "%s", what);
    for (char *c = reason; *c; ++c)
        if (*c < ' ' || *c > '~')
            *c = '?';
}

} // namespace

extern "C" otx_status
otx_openexr_read(
    const otx_openexr_picture *picture, otx_openexr_sink sink, void *user,
    char reason[OTX_OPENEXR_REASON_BYTES])
{
    reason[0] = '\0';
    try
    {
        if (picture->is_chroma)
            read_chroma(*picture, sink, user);
        else
            read_channels(*picture, sink, user);
        return OSDTEX_OK;
    }
    catch (const std::bad_alloc &)
    {
        return OSDTEX_ERROR_MEMORY;
    }
    catch (const std::exception &e)
    {
        keep_reason(e.what(), reason);
    }
    catch (...)
    {
        keep_reason("it does not say why", reason);
    }
    return OSDTEX_ERROR_FORMAT;
}
