//! Pictures as JPEG and PNG files.

use jpeg_encoder::{ColorType, Encoder, SamplingFactor};

/// A picture whose parts do not fit together, or too large for its format.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// More or fewer pixels than its width and height say.
    #[error("a picture of {width}×{height} pixels was given {pixels}")]
    Pixels {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// How many there are.
        pixels: usize,
    },
    /// The JPEG encoder refused it.
    #[error("cannot write a JPEG of it: {0}")]
    Jpeg(#[from] jpeg_encoder::EncodingError),
    /// The PNG encoder refused it.
    #[error("cannot write a PNG of it: {0}")]
    Png(#[from] png::EncodingError),
    /// JPEG cannot be so large.
    #[error("{width}×{height} pixels are too many for JPEG: at most 65,535 each way")]
    TooLarge {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
}

fn check(width: u32, height: u32, pixels: usize) -> Result<(), FileError> {
    if width as usize * height as usize == pixels && pixels > 0 {
        Ok(())
    } else {
        Err(FileError::Pixels { width, height, pixels })
    }
}

/// A JPEG file of sRGB pixels, row by row; `quality` from 1 to 100. Colour is kept at half the
/// resolution of brightness, as cameras do.
pub fn jpeg(
    width: u32,
    height: u32,
    colour: &[[u8; 3]],
    quality: u8,
) -> Result<Vec<u8>, FileError> {
    check(width, height, colour.len())?;
    let too_large = FileError::TooLarge { width, height };
    let (Ok(w), Ok(h)) = (u16::try_from(width), u16::try_from(height)) else {
        return Err(too_large);
    };
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, quality);
    encoder.set_sampling_factor(SamplingFactor::F_2_2);
    // Optimised tables would save a few per cent, but this encoder then writes a scan for each
    // component, whose subsampled colour zune-jpeg 0.5 reads as none (libjpeg reads it).
    encoder.set_optimized_huffman_tables(false);
    encoder.encode(colour.as_flattened(), w, h, ColorType::Rgb)?;
    Ok(file)
}

/// A PNG file of sRGB pixels, row by row.
pub fn png(width: u32, height: u32, colour: &[[u8; 3]]) -> Result<Vec<u8>, FileError> {
    check(width, height, colour.len())?;
    png_of(width, height, (png::ColorType::Rgb, png::BitDepth::Eight), colour.as_flattened())
}

/// A PNG file of one 16-bit value a pixel, such as depth or masks, row by row.
pub fn png_16(width: u32, height: u32, values: &[u16]) -> Result<Vec<u8>, FileError> {
    check(width, height, values.len())?;
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_be_bytes()).collect();
    png_of(width, height, (png::ColorType::Grayscale, png::BitDepth::Sixteen), &bytes)
}

fn png_of(
    width: u32,
    height: u32,
    (colour, bits): (png::ColorType, png::BitDepth),
    data: &[u8],
) -> Result<Vec<u8>, FileError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(colour);
    encoder.set_depth(bits);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(data)?;
    writer.finish()?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use zune_jpeg::JpegDecoder;
    use zune_jpeg::zune_core::bytestream::ZCursor;

    use super::*;

    const WIDTH: u32 = 37;
    const HEIGHT: u32 = 21;

    fn colours() -> Vec<[u8; 3]> {
        (0..WIDTH * HEIGHT).map(|n| [(n % WIDTH * 6) as u8, (n / WIDTH * 12) as u8, 90]).collect()
    }

    fn read_png(file: &[u8]) -> (png::OutputInfo, Vec<u8>) {
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut data).unwrap();
        (info, data)
    }

    #[test]
    fn a_jpeg_opens_again() {
        let file = jpeg(WIDTH, HEIGHT, &colours(), 90).unwrap();
        let mut decoder = JpegDecoder::new(ZCursor::new(&file));
        let data = decoder.decode().unwrap();
        assert_eq!(decoder.dimensions(), Some((WIDTH as usize, HEIGHT as usize)));
        let colours = colours();
        let misses = data.iter().zip(colours.as_flattened()).map(|(a, b)| a.abs_diff(*b));
        assert!(misses.map(u64::from).sum::<u64>() < 4 * data.len() as u64);
    }

    #[test]
    fn a_png_opens_again() {
        let (info, data) = read_png(&png(WIDTH, HEIGHT, &colours()).unwrap());
        assert_eq!((info.width, info.height), (WIDTH, HEIGHT));
        assert_eq!(data, colours().as_flattened());
    }

    #[test]
    fn sixteen_bits_open_again() {
        let values: Vec<u16> = (0..WIDTH * HEIGHT).map(|n| (n * 83) as u16).collect();
        let (info, data) = read_png(&png_16(WIDTH, HEIGHT, &values).unwrap());
        assert_eq!(info.bit_depth, png::BitDepth::Sixteen);
        let read = data.chunks(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]]));
        assert_eq!(read.collect::<Vec<u16>>(), values);
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        let error = jpeg(3, 2, &[[0; 3]; 5], 80).unwrap_err().to_string();
        assert_eq!(error, "a picture of 3×2 pixels was given 5");
        assert!(png(0, 0, &[]).is_err());
        let error = jpeg(70_000, 1, &vec![[0; 3]; 70_000], 80).unwrap_err().to_string();
        assert_eq!(error, "70000×1 pixels are too many for JPEG: at most 65,535 each way");
    }
}
