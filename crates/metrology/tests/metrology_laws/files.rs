//! Readers and the writer.

use std::path::Path;

use geometry::Side;
use metrology::{GdeNames, MetrologyError, TraceKind, read_gde, read_mka, write_mka};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::made::{measured, trace};

fn read(text: &str) -> Result<metrology::MeasuredGear, MetrologyError> {
    read_mka(text.as_bytes(), Path::new("g.mka"))
}

/// What is written is read back, to the last bit: values, values that are none, ranges, pitch; in either encoding.
#[test]
fn a_written_file_is_read_back() {
    let mut gear = measured(|tooth, x| (f64::from(tooth) - 14.3) * 0.01 * (x * 3.1).sin());
    gear.traces[3].deviations_um[7] = None;
    gear.traces[3].deviations_um[8] = Some(0.0);
    let helix = trace(&gear.header, TraceKind::Helix(95.1), (4, Side::Right), |z| -0.25 + 0.125 * z);
    gear.traces.push(helix);
    let text = write_mka(&gear);
    assert_eq!(read(&text).unwrap(), gear);
    let latin: Vec<u8> = text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
    assert_eq!(read_mka(&latin, Path::new("g.mka")).unwrap(), gear);
}

/// Headings as programs write them: letters at the tooth, curves of twist, helices by roll length, blocks of their own line.
#[test]
fn headings_of_all_kinds() {
    let head = "HEADER KS.MK.FILE\n 21 :mn:  1.0\n 22 :z:  52\n 23 :beta:  -12.5\n 24 :alpha:  20\n";
    let text = format!(
        "{head}Profil:  Zahn-Nr.: 2a links / 2 Werte  / z= 7.5\n .5 -2147483.648\n\
         Flankenlinie:\nZahn-Nr.: 3 rechts / 4  Werte  x= 8.742\n -2147483.65 1.5\n 2.5 .25\n\
         Verschränkung: Zahn-Nr.: 1k /Flankenlinie:3 links / 2  Werte  x= 10.263\n 1.0 2.0\n\
         Fußkreisdurchmesser / Höhe :     7.500\n   49.5 49.6\n"
    );
    let gear = read(&text).unwrap();
    assert_eq!(gear.header.helix_angle, (-12.5f64).to_radians());
    let told: Vec<_> = gear.traces.iter().map(|t| (t.tooth, t.side, t.deviations_um.clone())).collect();
    assert_eq!(told[0], (1, Side::Left, vec![Some(0.5), None]));
    assert_eq!(told[1], (2, Side::Right, vec![None, Some(1.5), Some(2.5), Some(0.25)]));
    assert_eq!(told[2], (0, Side::Left, vec![Some(1.0), Some(2.0)]));
    let TraceKind::Helix(diameter) = gear.traces[1].kind else { panic!("{:?}", gear.traces[1].kind) };
    assert!((gear.header.roll_length(diameter) - 8.742).abs() < 1e-12);
    assert_eq!(gear.traces[0].kind, TraceKind::Profile(7.5));
}

/// Every damage is told with its line.
#[test]
fn damaged_files_name_the_line() {
    let head = "HEADER KS.MK.FILE\n 21 :mn:  1.0\n 22 :z:  52\n 23 :beta:  0\n 24 :alpha:  20\n";
    let says = |rest: &str| read(&format!("{head}{rest}")).unwrap_err().to_string();
    let heading = "Profil: Zahn-Nr.: 1 links / 3 Werte z= 7.5\n";
    assert_eq!(
        says(&format!("{heading} 1 2\n")),
        "g.mka:6: the trace that begins here has 2 values, its heading says 3"
    );
    assert_eq!(
        says(&format!("{heading} 1 2 3\n 4\n")),
        "g.mka:6: the trace that begins here has 4 values, its heading says 3"
    );
    assert_eq!(says(&format!("{heading} 1 2 3,5\n")), "g.mka:7: expected a number, found `3,5`");
    assert_eq!(
        says("Profil: Zahn-Nr.: 0 links / 3 Werte z= 7.5\n"),
        "g.mka:6: expected a tooth, counted from 1, found `0`"
    );
    assert!(
        says("Profil: Zahn-Nr.: 1 oben / 3 Werte z= 7.5\n")
            .starts_with("g.mka:6: expected `Zahn-Nr.: <tooth> links|rechts")
    );
    assert_eq!(
        says("Profil: Zahn-Nr.: 53 links / 1 Werte z= 7.5\n 1\n"),
        "g.mka:6: expected a tooth of the gear, whose number of teeth is in line 22, found `53`"
    );
    assert_eq!(says(""), "g.mka: any curve is missing");
    assert_eq!(read("").unwrap_err().to_string(), "g.mka: line 22, the number of teeth, is missing");
    // A number that stands for no value is no depth, unless the file says so.
    let odd = format!("{heading} 1 -99999 3\n");
    assert_eq!(says(&odd), "g.mka: profile of tooth 1, left: -99999 um is more than a quarter of the module (250 um)");
    let told = read(&format!("{head}UNDEFINED -99999 ! none\n{odd}")).unwrap();
    assert_eq!(told.traces[0].deviations_um, [Some(1.0), None, Some(3.0)]);
    let pitch = "linke Zahnflanke\n Zahn-Nr.  fp  Fp  Fr\n\n 1 .1 .1 0\n 3 .1 .2 0\n";
    assert_eq!(says(pitch), "g.mka:10: expected the teeth one after the other, from 1, found `3`");
}

/// Files cut, with bytes changed, lines doubled and words moved: an error or a gear, never a panic.
#[test]
fn damaged_files_never_panic() {
    let mut small = measured(|tooth, x| f64::from(tooth) * 0.1 + x);
    small.traces.truncate(3);
    small.traces.iter_mut().for_each(|t| t.deviations_um.truncate(12));
    let bytes = write_mka(&small).into_bytes();
    let mut rng = ChaCha8Rng::seed_from_u64(46);
    let mut read_all = 0;
    let count = testing::cases(100_000, 1_000_000);
    for _ in 0..count {
        let mut own = bytes.clone();
        for _ in 0..rng.random_range(1..6) {
            let at = rng.random_range(0..own.len());
            match rng.random_range(0..5) {
                0 => own.truncate(at.max(1)),
                1 => own[at] = rng.random_range(0..=255),
                2 => own[at] = b" -.:/=0129dxz\n"[rng.random_range(0..14usize)],
                3 => {
                    let to = (at + rng.random_range(1..40)).min(own.len());
                    let part = own[at..to].to_vec();
                    let into = rng.random_range(0..=own.len());
                    own.splice(into..into, part);
                }
                _ => drop(own.drain(at..(at + rng.random_range(1..40usize)).min(own.len()))),
            }
            if own.is_empty() {
                break;
            }
        }
        if let Ok(gear) = read_mka(&own, Path::new("g.mka")) {
            read_all += 1;
            let _ = metrology::evaluate(&gear, &crate::made::gear());
            let _ = metrology::flanks(&gear, &crate::made::gear());
        }
    }
    println!("{read_all} of {count} damaged files are gears");
    assert!(read_all > 100);
}

fn names() -> GdeNames {
    let name = str::to_owned;
    GdeNames {
        teeth: name("gear/@z"),
        normal_module: name("gear/mn"),
        helix_angle: name("gear/beta"),
        pressure_angle: name("gear/alpha"),
        profiles: name("measurement/profile"),
        helices: name("measurement/lead"),
        tooth: name("@tooth"),
        first_tooth: 1,
        side: name("@datum_face"),
        left: name("A"),
        right: name("B"),
        place: name("at"),
        from: name("range/@from"),
        to: name("range/@to"),
        values: name("points/v"),
        undefined: Some(-9999.0),
    }
}

const GDE: &str = "<gde>\n<gear z='30'><mn>3</mn><beta>20</beta><alpha>20</alpha></gear>\n<measurement>\n\
    <profile tooth='1' datum_face='A'><at>0</at><range from='91' to='101'/><points><v>1</v><v>-9999</v><v>2.5</v></points></profile>\n\
    <lead tooth='30' datum_face='B'><at>95.7</at><range from='-9' to='9'/><points><v>0 1, 2</v></points></lead>\n\
    </measurement></gde>\n";

/// What the map names is found; which word is left is said, not guessed.
#[test]
fn gde_is_read_through_its_names() {
    let gear = read_gde(GDE, &names(), Path::new("g.xml")).unwrap();
    assert_eq!(gear.header.teeth, 30);
    assert_eq!((gear.header.profile_measured, gear.header.helix_measured), (Some([91.0, 101.0]), Some([-9.0, 9.0])));
    assert_eq!(gear.traces[0].deviations_um, [Some(1.0), None, Some(2.5)]);
    assert_eq!((gear.traces[0].tooth, gear.traces[0].side), (0, Side::Left));
    assert_eq!(
        (gear.traces[1].tooth, gear.traces[1].side, gear.traces[1].kind),
        (29, Side::Right, TraceKind::Helix(95.7))
    );
    let swapped = GdeNames { left: "B".into(), right: "A".into(), ..names() };
    assert_eq!(read_gde(GDE, &swapped, Path::new("g.xml")).unwrap().traces[0].side, Side::Right);
    let says = |text: &str| read_gde(text, &names(), Path::new("g.xml")).unwrap_err().to_string();
    assert!(
        says(&GDE.replace("tooth='30'", "tooth='31'")).starts_with("g.xml:5: expected a tooth of the gear, found `31`")
    );
    assert!(
        says(&GDE.replace("face='B'", "face='C'"))
            .starts_with("g.xml:5: expected a side by its names in the map, found `C`")
    );
    assert!(says(&GDE.replace("<v>2.5</v>", "<v>2,x</v>")).contains("g.xml:4: expected a number, found `x`"));
    assert!(says("<gde>").starts_with("g.xml:1: "));
    // A comma between digits beside blanks is a decimal mark; alone it separates.
    let read = |values: &str| {
        read_gde(&GDE.replace("<v>0 1, 2</v>", &format!("<v>{values}</v>")), &names(), Path::new("g.xml"))
    };
    let said = read("0,1 0,2 0,3").unwrap_err();
    assert!(said.to_string().contains("expected a number with a decimal point, found `0,1`"), "{said}");
    assert_eq!(read("0,1,2").unwrap(), read("0 1 2").unwrap());
}

/// The map of names is a file: what is missing or not known in it is told with its line.
#[test]
fn names_are_read_from_a_file() {
    let text = "teeth = \"gear/@z\"\nnormal_module = \"gear/mn\"\nhelix_angle = \"gear/beta\"\n\
        pressure_angle = \"gear/alpha\"\nprofiles = \"measurement/profile\"\nhelices = \"measurement/lead\"\n\
        tooth = \"@tooth\"\nside = \"@datum_face\"\nleft = \"A\"\nright = \"B\"\nplace = \"at\"\n\
        from = \"range/@from\"\nto = \"range/@to\"\nvalues = \"points/v\"\nundefined = -9999.0\n";
    let parse = |text: &str| GdeNames::parse(text, Path::new("names.toml"));
    assert_eq!(parse(text).unwrap(), names());
    let says = |text: &str| parse(text).unwrap_err().to_string();
    assert!(says(&text.replace("left", "links")).starts_with("names.toml:9: unknown field `links`"));
    assert!(says(&text.replace("teeth = \"gear/@z\"\n", "")).contains("missing field `teeth`"));
    assert!(
        says(&text.replace("\"at\"", "3")).starts_with("names.toml:11: "),
        "{}",
        says(&text.replace("\"at\"", "3"))
    );
}
