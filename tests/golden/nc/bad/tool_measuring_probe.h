; run: failed line 4: Tool number not permitted: tool 30 is a touch probe
BEGIN PGM BAD MM
TOOL CALL 30 Z
TCH PROBE 481 CAL. TOOL LENGTH ~
    Q340=+1 ~
    Q260=+100 ~
    Q341=+0
END PGM BAD MM
