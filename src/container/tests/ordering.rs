//! The order of a log is the order of arrival, and equal calls give equal bytes.

use proptest::prelude::*;

use super::*;

fn arrivals() -> impl Strategy<Value = Vec<(usize, u64)>> {
    // Steps of zero are common, so that many messages share a time.
    proptest::collection::vec((0..4_usize, prop_oneof![4 => Just(0_u64), 1 => 1..3_u64]), 0..200)
        .prop_map(|steps| {
            let mut time = 5;
            let timed = steps.into_iter().map(|(class, step)| {
                time += step;
                (class, time)
            });
            timed.collect()
        })
}

proptest! {
    #[test]
    fn a_log_reads_back_in_the_order_of_arrival(
        arrivals in arrivals(),
        event_chunk_bytes in 1..2000_usize,
        sensor_chunk_bytes in 1..2000_usize,
    ) {
        let options = LogOptions { event_chunk_bytes, sensor_chunk_bytes, ..Default::default() };
        let (bytes, sent) = write_all(&arrivals, options.clone());
        let log = open(&bytes);
        prop_assert!(log.damage().is_empty());
        prop_assert!(log.is_finished());
        let (read, damage) = read(&log);
        prop_assert_eq!(&read, &sent);
        prop_assert!(damage.is_empty());
        // Both orders of reading agree, and so do two writers.
        let scanned = LogFile::scan(Arc::new(bytes.clone()), Limits::default()).unwrap();
        prop_assert_eq!(super::read(&scanned).0, sent);
        prop_assert_eq!(write_all(&arrivals, options).0, bytes);
    }

    #[test]
    fn what_is_written_through_survives_a_crash(arrivals in arrivals(), cut in 0..200_usize) {
        let mut writer = LogWriter::new(Vec::new(), small_chunks()).unwrap();
        let handles = CLASSES.map(|(topic, class)| writer.register(spec(topic, class)).unwrap());
        let mut through = 0;
        for (sequence, (class, time)) in arrivals.iter().enumerate() {
            let n = sequence as u32;
            let done = writer.write(handles[*class], n, *time, *time, &[1, 2, 3]).unwrap();
            prop_assert!(done.written_through >= through && done.written_through <= done.accepted);
            through = done.written_through;
            if sequence == cut {
                through = writer.flush().unwrap().written_through;
                prop_assert_eq!(through, sequence as u64 + 1);
            }
        }
        let (read, _) = read(&open(writer.get_ref()));
        let mut numbers: Vec<_> = read.iter().map(|sent| sent.sequence).collect();
        numbers.sort_unstable();
        for sequence in 0..through as u32 {
            prop_assert!(numbers.binary_search(&sequence).is_ok());
        }
    }

    #[test]
    fn a_filter_takes_what_it_says(
        arrivals in arrivals(),
        from in 0..80_u64,
        span in 0..80_u64,
        after in 0..200_usize,
    ) {
        let (bytes, sent) = write_all(&arrivals, small_chunks());
        let log = open(&bytes);
        let ids = log.channels().values().filter(|c| c.topic == "/change" || c.topic == "/jpeg");
        let mut filter = MessageFilter::on_channels(ids.map(|channel| channel.id));
        (filter.from_time, filter.until_time) = (from, from + span);
        let mut keys = Vec::new();
        let mut cursor = log.messages(MessageFilter::default());
        while let Some(message) = cursor.next_message().unwrap() {
            keys.push(message.key());
        }
        filter.after = keys.get(after).copied();
        let skipped = if filter.after.is_some() { after + 1 } else { 0 };
        let expected = sent.into_iter().skip(skipped).filter(|m| {
            matches!(m.topic.as_str(), "/change" | "/jpeg")
                && (from..=from + span).contains(&m.log_time)
        });
        prop_assert_eq!(read_filtered(&log, filter).0, expected.collect::<Vec<_>>());
    }
}

#[test]
fn time_that_goes_back_is_refused_and_changes_nothing() {
    let mut writer = LogWriter::new(Vec::new(), small_chunks()).unwrap();
    let handle = writer.register(spec("/change", ChunkClass::Event)).unwrap();
    writer.write(handle, 0, 10, 10, b"a").unwrap();
    let refused = writer.write(handle, 1, 9, 9, b"b");
    assert!(matches!(refused, Err(WriteError::TimeWentBack { previous: 10, .. })));
    let bytes = writer.finish().unwrap();
    assert_eq!(open(&bytes).statistics().unwrap().message_count, 1);
}

#[test]
fn color_and_depth_with_equal_times_do_not_shred_the_chunks() {
    let arrivals: Vec<_> = (0..400).map(|i| (1 - i % 2, i as u64 / 2)).collect();
    let (bytes, sent) = write_all(&arrivals, LogOptions::default());
    let log = open(&bytes);
    assert_eq!(log.chunks().len(), 2);
    assert_eq!(read(&log).0, sent);
}

#[test]
fn a_failed_write_poisons_the_writer() {
    struct Full(usize);
    impl std::io::Write for Full {
        fn write(&mut self, buf: &[u8]) -> std::io::Result<usize> {
            self.0 = self.0.checked_sub(buf.len()).ok_or(std::io::ErrorKind::StorageFull)?;
            Ok(buf.len())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    let mut writer = LogWriter::new(Full(100), small_chunks()).unwrap();
    let handle = writer.register(spec("/change", ChunkClass::Event)).unwrap();
    writer.write(handle, 0, 1, 1, b"a").unwrap();
    assert!(matches!(writer.flush(), Err(WriteError::Io(_))));
    assert!(matches!(writer.write(handle, 1, 2, 2, b"b"), Err(WriteError::Poisoned)));
}
