; run: failed line 3: Preset not found: row 77
BEGIN PGM BAD MM
CYCL DEF 247 DATUM SETTING ~
    Q339=+77
END PGM BAD MM
