//! Noise is reproducible, and as large as its model says.

use super::*;

const WIDTH: u32 = 160;

fn camera() -> Camera {
    Camera::with_fov(WIDTH, 120, 1.2)
}

/// A grey wall square to the optical axis.
fn wall(depth_m: f32) -> Frame {
    let count = 160 * 120;
    Frame {
        width: WIDTH,
        height: 120,
        colour: vec![[118; 3]; count],
        depth_m: vec![depth_m; count],
        mask: vec![0; count],
    }
}

fn take(frame: &Frame, noise: &NoiseConfig, number: u64) -> Picture {
    Picture::take(frame, &camera(), noise, 5, number)
}

/// Mean and standard deviation.
fn spread(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let values: Vec<f64> = values.collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let square = values.iter().map(|it| (it - mean) * (it - mean)).sum::<f64>();
    (mean, (square / values.len() as f64).sqrt())
}

#[test]
fn a_perfect_camera_hands_out_what_it_sees() {
    let frame = Frame { colour: (0..19_200).map(|n| [n as u8; 3]).collect(), ..wall(1.2345) };
    let picture = take(&frame, &NoiseConfig::none(), 1);
    assert_eq!(picture.colour, frame.colour);
    assert_eq!(picture.depth_mm, frame.depth_mm());
}

/// At `depth_m`, the spread is to be that of noise and rounding to steps, both times z².
#[track_caller]
fn check_depth(depth_m: f32) {
    let config = NoiseConfig { baseline_m: 0.0, ..NoiseConfig::default() };
    let all = (0..8).flat_map(|number| take(&wall(depth_m), &config, number).depth_mm);
    let (mean, sigma) = spread(all.map(|mm| f64::from(mm) / 1000.0));
    let square = f64::from(depth_m).powi(2);
    let disparity = config.depth_sigma_m.powi(2) + config.depth_step_m.powi(2) / 12.0;
    // And whole millimetres.
    let expected = (square * square * disparity + 1e-6 / 12.0).sqrt();
    assert!((mean - f64::from(depth_m)).abs() < 0.5 * expected, "mean {mean} at {depth_m}");
    assert!((sigma / expected - 1.0).abs() < 0.12, "{sigma} instead of {expected} at {depth_m}");
}

#[test]
fn depth_noise_grows_with_the_square_of_depth() {
    for depth_m in [0.8, 1.7, 3.0, 4.9] {
        check_depth(depth_m);
    }
}

#[test]
fn depth_comes_in_the_steps_of_disparity() {
    let picture = take(&wall(3.0), &NoiseConfig::default(), 0);
    let mut depths: Vec<u16> = picture.depth_mm.iter().copied().filter(|mm| *mm > 0).collect();
    depths.sort_unstable();
    depths.dedup();
    assert!((3..12).contains(&depths.len()), "{depths:?}");
    let step = depths[1] - depths[0];
    assert!((24..=27).contains(&step), "{step} mm at 3 m instead of 2.85 mm · 3²");
}

#[test]
fn noise_is_alike_within_a_window_and_not_beyond() {
    let config = NoiseConfig { depth_step_m: 0.0, baseline_m: 0.0, ..NoiseConfig::default() };
    let picture = take(&wall(4.0), &config, 0);
    let differing = |distance: usize| {
        let rows = picture.depth_mm.chunks(160);
        let pairs = rows.flat_map(|row| row.iter().zip(&row[distance..]));
        spread(pairs.map(|(a, b)| f64::from(*a) - f64::from(*b))).1
    };
    assert!(differing(1) < 0.4 * differing(40), "{} {}", differing(1), differing(40));
}

#[test]
fn what_is_too_near_too_far_or_nothing_has_no_depth() {
    for depth_m in [0.0, 0.2, 9.0] {
        let picture = take(&wall(depth_m), &NoiseConfig::default(), 0);
        assert!(picture.depth_mm.iter().all(|mm| *mm == 0), "{depth_m}");
    }
}

#[test]
fn a_thing_throws_a_shadow_of_the_projector_to_its_left() {
    let mut frame = wall(3.0);
    for row in frame.depth_m.chunks_mut(160) {
        row[80..100].fill(1.0);
    }
    let config = NoiseConfig { edge_holes: 0.0, ..NoiseConfig::default() };
    let picture = take(&frame, &config, 0);
    // f·b·(1/1 − 1/3)
    let width = (camera().focal[0] * 0.075 * (1.0 - 1.0 / 3.0)) as usize;
    for row in picture.depth_mm.chunks(160) {
        let holes: Vec<usize> = (0..160).filter(|n| row[*n] == 0).collect();
        assert_eq!(holes, (80 - width..80).collect::<Vec<usize>>());
    }
}

#[test]
fn jumps_in_depth_have_holes() {
    let mut frame = wall(3.0);
    for row in frame.depth_m.chunks_mut(160) {
        row[80..].fill(2.0);
    }
    let config = NoiseConfig { baseline_m: 0.0, ..NoiseConfig::default() };
    let picture = take(&frame, &config, 0);
    let holes = |column: usize| picture.depth_mm.chunks(160).filter(|row| row[column] == 0).count();
    assert!((15..60).contains(&holes(79)) && (15..60).contains(&holes(80)), "{}", holes(80));
    assert_eq!((holes(78), holes(81)), (0, 0));
}

/// A floor 1 m below the camera, seen at `angle` at every row.
#[test]
fn surfaces_seen_at_a_grazing_angle_have_no_depth() {
    let (camera, mut frame) = (camera(), wall(0.0));
    for (row, depths) in frame.depth_m.chunks_mut(160).enumerate() {
        let down = (row as f64 - camera.centre[1]) / camera.focal[1];
        depths.fill(if down > 0.0 { (1.0 / down) as f32 } else { 0.0 });
    }
    let config = NoiseConfig { max_depth_m: 60.0, ..NoiseConfig::none() };
    let config = NoiseConfig { grazing_deg: 80.0, ..config };
    let picture = take(&frame, &config, 0);
    for (row, depths) in picture.depth_mm.chunks(160).enumerate().skip(62).take(57) {
        let down = (row as f64 - camera.centre[1]) / camera.focal[1];
        // In the middle column the ray is (0, down, 1) and the normal (0, -1, 0).
        let incidence = (down / (1.0 + down * down).sqrt()).acos().to_degrees();
        if (incidence - 80.0).abs() > 0.5 {
            assert_eq!(depths[80] == 0, incidence > 80.0, "{incidence} at row {row}");
        }
    }
}

#[test]
fn colour_noise_is_as_large_as_it_says() {
    let config = NoiseConfig { colour_sigma: 4.0, ..NoiseConfig::none() };
    let picture = take(&wall(1.0), &config, 0);
    let (mean, sigma) = spread(picture.colour.iter().map(|colour| f64::from(colour[1])));
    assert!((mean - 118.0).abs() < 0.2 && (sigma - 4.0).abs() < 0.15, "{mean} {sigma}");
}

#[test]
fn exposure_brings_dark_pictures_towards_the_middle() {
    let dark = Frame { colour: vec![[70; 3]; 19_200], ..wall(1.0) };
    let mean = |exposure: f64| {
        let config = NoiseConfig { exposure, ..NoiseConfig::none() };
        f64::from(take(&dark, &config, 0).colour[0][0])
    };
    assert!(mean(0.0) < mean(0.5) && mean(0.5) < mean(1.0) && mean(1.0) < 119.0);
}

#[test]
fn exposure_differs_from_picture_to_picture() {
    let config = NoiseConfig { exposure_sigma: 0.1, ..NoiseConfig::none() };
    let level = |number| take(&wall(1.0), &config, number).colour[0];
    assert_ne!(level(0), level(1));
}

#[test]
fn corners_are_darker_than_the_middle() {
    let config = NoiseConfig { vignetting: 0.3, ..NoiseConfig::none() };
    let colour = take(&wall(1.0), &config, 0).colour;
    assert!(colour[0][0] + 10 < colour[60 * 160 + 80][0]);
}

#[test]
fn a_seed_gives_the_same_noise_for_any_number_of_threads() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| take(&wall(2.0), &NoiseConfig::default(), 3))
    };
    assert_eq!(with(1), with(2));
    assert_ne!(with(1), take(&wall(2.0), &NoiseConfig::default(), 4));
    let other = Picture::take(&wall(2.0), &camera(), &NoiseConfig::default(), 6, 3);
    assert_ne!(with(1), other);
}

#[test]
fn noise_that_no_camera_has_is_refused_by_field() {
    assert_eq!(NoiseConfig::default().check(), Ok(()));
    assert_eq!(NoiseConfig::none().check(), Ok(()));
    let negative = NoiseConfig { depth_sigma_m: -0.1, ..NoiseConfig::default() };
    let error = negative.check().unwrap_err().to_string();
    assert_eq!(error, "noise.depth_sigma_m is -0.1: it must be from 0 to 1");
    assert!(NoiseConfig { window_px: 0, ..NoiseConfig::default() }.check().is_err());
    assert!(NoiseConfig { exposure: f64::NAN, ..NoiseConfig::default() }.check().is_err());
}
