# So many cases as studies run them, one process each: `snakemake --snakefile cases.smk --config cases=N program=P scene=S --cores C`.
rule all:
    input: expand("{n}.done", n=range(int(config["cases"])))

rule case:
    output: touch("{n}.done")
    shell: "{config[program]} run {config[scene]} --out {wildcards.n} --quiet --threads 1 --no-fields "
           "--set 'integrator.scheme=\"musl\"' --set integrator.step=2.5e-8 --set time.end={config[end]}"
