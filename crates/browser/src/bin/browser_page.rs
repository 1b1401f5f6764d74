//! Makes the page that solves a pair by itself: `browser_page PROGRAM.wasm OUT.html`.

#[cfg(not(target_family = "wasm"))]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    use std::{fs, io::Write, path::Path};

    use base64::{Engine, engine::general_purpose::STANDARD};
    use flate2::{Compression, write::GzEncoder};
    use live::page::{Answers, html};
    use scene::Starter;

    let words: Vec<String> = std::env::args().skip(1).collect();
    let [program, out] = &words[..] else { return Err("PROGRAM.wasm OUT.html are wanted".into()) };
    let mut packed = GzEncoder::new(Vec::new(), Compression::best());
    packed.write_all(&fs::read(program)?)?;
    let program = STANDARD.encode(packed.finish()?);
    let text = Starter { name: "helical-30x30-beta20".into(), ..Starter::default() }.text("scene.toml");
    let page = html((&text, Path::new("scene.toml")), Answers::Page(&program))?;
    Ok(fs::write(out, page)?)
}

#[cfg(target_family = "wasm")]
fn main() {}
